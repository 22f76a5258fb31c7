#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/hand/hand_model.h"
#include "render/glove_colors.h"

namespace glovebench::render {

/// How a surface reflects light: diffuse, with a Blinn-Phong highlight and a fixed pattern.
struct Material {
  Eigen::Vector3f albedo = Eigen::Vector3f::Zero();  ///< linear RGB, 0..1
  float gloss = 0;                                   ///< strength of the highlight, 0..1
  float shininess = 20;                              ///< its exponent
  float pattern = 0;                                 ///< relative amplitude of the albedo's pattern, 0..1
  float pattern_size = 0.01f;                        ///< m
};

/// Materials 1..kColorCount are the glove's colors; these follow.
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

/// Triangles, counter-clockwise seen from outside.
struct SurfaceMesh {
  std::vector<Eigen::Vector3f> vertices;  ///< m
  std::vector<Eigen::Vector3f> normals;   ///< unit length
  std::vector<uint8_t> materials;         ///< of each vertex
  std::vector<uint32_t> indices;          ///< three a triangle
};

struct SceneConfig {
  Shader shader = Shader::first_subject;
  bool clutter = true;  ///< boxes and balls on the table, colored nearly like some of the glove's patches
  bool clutter_in_volume = false;  ///< one more box, tall enough to reach into the working volume (z 0.90 m)
};

/// What stands around the hand, in the frame of the IR camera, which looks down on it: a table top 1.06 m away,
/// 1.0 m x 0.74 m, a floor 1.78 m away. But for `clutter_in_volume` all of it lies beyond 1.0 m.
struct Scene {
  SurfaceMesh surroundings;         ///< IR camera frame
  std::vector<Material> materials;  ///< kMaterialCount
};
Scene make_scene(const SceneConfig& config);

/// The bare forearm that comes out of the glove's cuff, 200 mm long, in the frame of the forearm joint. Its cross
/// section is fitted to the cuff's end of that hand, whose posture does not matter.
SurfaceMesh make_forearm(const PosedHand& hand);

}  // namespace glovebench::render
