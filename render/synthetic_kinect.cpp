#include "render/synthetic_kinect.h"

#include "core/base/error.h"
#include "core/kinect/disparity.h"

namespace glovebench::render {
namespace {

void require_possible(const NoiseConfig& noise) {
  const std::vector<std::string> problems = noise.problems();
  if (!problems.empty()) throw Error("noise: " + problems.front());
}

}  // namespace

DeviceFrame make_device_frame(const RgbdImages& images, const RgbdCalibration& calibration, int64_t timestamp_us,
                              const NoiseConfig& noise, const FrameKey& key) {
  require_possible(noise);
  const DepthImage depth = add_depth_noise(images.depth, calibration.ir, noise, key);
  DeviceFrame frame{.raw_disparity = Image<uint16_t>(depth.width(), depth.height()),
                    .color = add_color_noise(images.color, noise.color_sigma_gray, key),
                    .depth_timestamp_us = timestamp_us,
                    .color_timestamp_us = timestamp_us};
  for (size_t i = 0; i < depth.size(); ++i)
    frame.raw_disparity[i] = disparity_from_depth(depth[i], calibration.disparity);
  return frame;
}

SyntheticKinect::SyntheticKinect(const RgbdCalibration& calibration, Subject subject, std::vector<HandFrame> frames,
                                 SyntheticKinectConfig config)
    : renderer_(calibration, subject, config.scene),
      subject_(std::move(subject)),
      frames_(std::move(frames)),
      config_(std::move(config)) {
  require_possible(config_.noise);
}

bool SyntheticKinect::render_next() {
  if (next_ == frames_.size()) return false;
  const HandFrame& frame = frames_[next_++];
  hand_ = subject_.pose(frame.posture);
  truth_ = renderer_.render(hand_, frame.T_camera_hand, config_.lighting);
  return true;
}

std::optional<DeviceFrame> SyntheticKinect::next_frame() {
  const FrameKey key{config_.seed, config_.sequence, config_.first_frame + static_cast<int64_t>(next_)};
  if (!render_next()) return std::nullopt;
  return make_device_frame(truth_, calibration(), frames_[next_ - 1].timestamp_us, config_.noise, key);
}

const RgbdImages& SyntheticKinect::truth() const {
  check(next_ > 0, "the truth of a frame is asked for after the frame");
  return truth_;
}

TrueImages SyntheticKinect::color_truth() {
  check(next_ > 0, "the truth of a frame is asked for after the frame");
  return renderer_.render_color_truth(hand_, frames_[next_ - 1].T_camera_hand);
}

const PosedHand& SyntheticKinect::true_hand() const {
  check(next_ > 0, "the hand of a frame is asked for after the frame");
  return hand_;
}

}  // namespace glovebench::render
