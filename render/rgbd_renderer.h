#pragma once

#include <memory>

#include "core/base/image.h"
#include "core/camera/rgbd_calibration.h"
#include "render/lighting.h"
#include "render/scene.h"
#include "render/subjects/subject.h"

namespace glovebench::render {

/// What an ideal Kinect would see of the whole scene, and the truth beside it.
struct RgbdImages {
  ColorImage color;      ///< RGB camera, sRGB-coded
  DepthImage depth;      ///< IR camera, z, m, at each pixel's center
  LabelImage label;      ///< IR camera, 1..kColorCount on visible glove, else 0
  Image<uint8_t> patch;  ///< IR camera, patch + 1 on visible glove, else 0
};

/// Draws one subject's hand in a scene, from the two cameras of a Kinect. Light is added up in linear RGB: diffuse
/// (Lambert) and a highlight (Blinn-Phong), no shadows; then the mean of 2x2 samples a pixel is taken and
/// sRGB-coded to 8 bits (values over 1 are cut off). Depth and truth have one sample a pixel. An object serves one
/// thread at a time; the images do not depend on the thread.
class RgbdRenderer {
 public:
  /// Throws Error if no OpenGL context can be had.
  RgbdRenderer(const RgbdCalibration& calibration, Subject subject, const SceneConfig& scene);
  ~RgbdRenderer();

  RgbdImages render(const PosedHand& hand, const Eigen::Isometry3d& T_camera_hand, const Lighting& lighting);
  /// True labels in the pixels of the RGB camera, for calibrating the segmentation.
  LabelImage render_color_labels(const PosedHand& hand, const Eigen::Isometry3d& T_camera_hand);
  const RgbdCalibration& calibration() const { return calibration_; }

 private:
  struct State;
  RgbdCalibration calibration_;
  std::unique_ptr<State> state_;
};

}  // namespace glovebench::render
