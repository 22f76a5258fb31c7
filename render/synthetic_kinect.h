#pragma once

#include <string>
#include <vector>

#include "core/hand/posture.h"
#include "core/kinect/device.h"
#include "render/noise/noise_model.h"
#include "render/rgbd_renderer.h"

namespace glovebench::render {

struct SyntheticKinectConfig {
  SceneConfig scene;
  Lighting lighting;
  NoiseConfig noise;
  uint64_t seed = 1;
  std::string sequence;
  int first_frame = 0;  ///< selects the noise
};

/// Adds color noise, depth noise and 11-bit disparity.
/// Throws: Error for impossible noise.
DeviceFrame make_device_frame(const RgbdImages& images, const RgbdCalibration& calibration, int64_t timestamp_us,
                              const NoiseConfig& noise, const FrameKey& key);

/// A Kinect before a rendered hand. For one thread at a time.
class SyntheticKinect : public Device {
 public:
  /// Throws: Error without OpenGL or for an impossible configuration.
  SyntheticKinect(const RgbdCalibration& calibration, Subject subject, std::vector<HandFrame> frames,
                  SyntheticKinectConfig config);

  const RgbdCalibration& calibration() const override { return renderer_.calibration(); }
  std::optional<DeviceFrame> next_frame() override;
  /// The same without the device's frame and its noise. False at the end.
  bool render_next();

  /// The last frame's ideal images. Truth is for the evaluator only.
  const RgbdImages& truth() const;
  /// The same from the RGB camera, rendered at each call.
  TrueImages color_truth();
  const PosedHand& true_hand() const;

 private:
  RgbdRenderer renderer_;
  Subject subject_;
  std::vector<HandFrame> frames_;
  SyntheticKinectConfig config_;
  size_t next_ = 0;
  PosedHand hand_;
  RgbdImages truth_;
};

}  // namespace glovebench::render
