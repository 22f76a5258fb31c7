#pragma once

#include <memory>

#include "core/base/image.h"
#include "core/camera/rgbd_calibration.h"
#include "render/lighting.h"
#include "render/scene.h"
#include "render/subjects/subject.h"

namespace glovebench::render {

/// An ideal Kinect's images, and the truth.
struct RgbdImages {
  ColorImage color;      ///< RGB camera, sRGB-coded
  DepthImage depth;      ///< IR camera, z, m, at pixel centers
  LabelImage label;      ///< IR camera; 1..kColorCount, else 0
  Image<uint8_t> patch;  ///< IR camera; patch + 1, else 0
};

/// One camera's view at its pixel centers.
struct TrueImages {
  DepthImage depth;       ///< z, m
  LabelImage label;       ///< 1..kColorCount, else 0
  Image<uint8_t> patch;   ///< patch + 1, else 0
  LabelImage whole_hand;  ///< label of the hand, also where something hides it
};

/// Renders a Kinect's two views, without shadows. Colors are means of 2x2 samples; depth and truth are single
/// ones. For one thread at a time.
class RgbdRenderer {
 public:
  /// Throws: Error without OpenGL.
  RgbdRenderer(const RgbdCalibration& calibration, Subject subject, const SceneConfig& scene);
  ~RgbdRenderer();

  RgbdImages render(const PosedHand& hand, const Eigen::Isometry3d& T_camera_hand, const Lighting& lighting);
  /// True labels in RGB pixels.
  LabelImage render_color_labels(const PosedHand& hand, const Eigen::Isometry3d& T_camera_hand);
  /// The truth in RGB pixels and in the RGB camera's frame.
  TrueImages render_color_truth(const PosedHand& hand, const Eigen::Isometry3d& T_camera_hand);
  const RgbdCalibration& calibration() const { return calibration_; }

 private:
  struct State;
  RgbdCalibration calibration_;
  std::unique_ptr<State> state_;
};

}  // namespace glovebench::render
