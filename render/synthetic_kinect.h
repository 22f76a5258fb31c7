#pragma once

#include <string>
#include <vector>

#include "core/hand/hand_frame.h"
#include "core/kinect/device.h"
#include "render/noise/noise_model.h"
#include "render/rgbd_renderer.h"

namespace glovebench::render {

struct SyntheticKinectConfig {
  SceneConfig scene;
  Lighting lighting;
  NoiseConfig noise;
  uint64_t seed = 1;     ///< of all noise
  std::string sequence;  ///< names the noise streams, e.g. the trajectory's name
  int first_frame = 0;   ///< number of the first frame in that sequence: the noise of a frame hangs on its number
};

/// The sensor's part: color noise, depth noise and, always, 11-bit disparity. Frames that differ in noise only can
/// share their images. Color and depth are taken at the same moment. Throws Error if the noise is impossible.
DeviceFrame make_device_frame(const RgbdImages& images, const RgbdCalibration& calibration, int64_t timestamp_us,
                              const NoiseConfig& noise, const FrameKey& key);

/// A Kinect in front of a rendered hand. The tracker gets its device frames; the truth stays on the evaluator's
/// side. Serves one thread at a time; its frames depend on nothing but its arguments.
class SyntheticKinect : public Device {
 public:
  /// Throws Error if no OpenGL context can be had or the configuration is impossible.
  SyntheticKinect(const RgbdCalibration& calibration, Subject subject, std::vector<HandFrame> frames,
                  SyntheticKinectConfig config);

  const RgbdCalibration& calibration() const override { return renderer_.calibration(); }
  std::optional<DeviceFrame> next_frame() override;

  /// The ideal images that the last frame was made of, for the evaluator only. A frame must have been taken.
  const RgbdImages& truth() const;

 private:
  RgbdRenderer renderer_;
  Subject subject_;
  std::vector<HandFrame> frames_;
  SyntheticKinectConfig config_;
  size_t next_ = 0;
  RgbdImages truth_;
};

}  // namespace glovebench::render
