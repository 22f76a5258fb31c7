#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/hand/hand_model.h"
#include "core/hand/posture.h"
#include "render/glove_colors.h"

namespace glovebench::render {

/// Diffuse, with a Blinn-Phong highlight.
struct Material {
  Eigen::Vector3f albedo = Eigen::Vector3f::Zero();  ///< linear RGB, 0..1
  float gloss = 0;
  float shininess = 20;
  float pattern = 0;           ///< relative amplitude, 0..1
  float pattern_size = 0.01f;  ///< m
};

/// Materials 1..kColorCount are the glove's colors.
enum SceneMaterial : uint8_t {
  kSkin = kColorCount + 1,
  kTable,
  kFloor,
  kClutterRed,
  kClutterGreen,
  kClutterBlue,
  kClutterYellow,
  kClutterWhite,
  kMaterialCount
};

/// Triangles, counter-clockwise from outside.
struct SurfaceMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3f> normals;  ///< unit length
  std::vector<uint8_t> materials;        ///< of vertices
  std::vector<uint32_t> indices;
};

struct SceneConfig {
  Shader shader = Shader::first_subject;
  Appearance appearance = Appearance::glove;  ///< labels are always the glove's
  bool clutter = true;                        ///< objects of glove-like colors on the table
  bool clutter_in_volume = false;             ///< a box in the working volume (z 0.90 m)
};

/// Surroundings, IR camera's frame: table top (1.0 m x 0.74 m, at 1.06 m), floor (at 1.78 m).
struct Scene {
  SurfaceMesh surroundings;
  std::vector<Material> materials;  ///< kMaterialCount
};
Scene make_scene(const SceneConfig& config);

/// 200 mm long from the cuff, in the forearm joint's frame.
SurfaceMesh make_forearm(const PosedHand& hand);

}  // namespace glovebench::render
