#include "eval/sources/paired_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace glovebench::eval {
namespace {

using Pairer = FramePairer<size_t, size_t>;

class PairedRecording : public Device {
 public:
  PairedRecording(std::string where, const RgbdCalibration& calibration, RecordedImages images, int64_t max_gap_us)
      : where_(std::move(where)), calibration_(calibration), images_(std::move(images)) {
    using Arrival = std::tuple<int64_t, bool, size_t>;  // at equal times depth comes first
    std::vector<Arrival> arrivals;
    arrivals.reserve(images_.depth_us.size() + images_.color_us.size());
    for (size_t i = 0; i < images_.depth_us.size(); ++i) arrivals.emplace_back(images_.depth_us[i], false, i);
    for (size_t i = 0; i < images_.color_us.size(); ++i) arrivals.emplace_back(images_.color_us[i], true, i);
    std::ranges::sort(arrivals);
    Pairer pairer({.max_gap_us = max_gap_us});
    for (const auto& [time_us, is_color, index] : arrivals)
      is_color ? pairer.push_color(time_us, index) : pairer.push_depth(time_us, index);
    pairer.finish();
    while (const auto pair = pairer.pop()) pairs_.push_back(*pair);
    dropped_ = pairer.unpaired() + pairer.went_back();
    if (pairs_.empty())
      throw Error(where_, "frames",
                  fmt::format("{} depth and {} color images", images_.depth_us.size(), images_.color_us.size()),
                  fmt::format("at least one pair within {} ms", max_gap_us / 1000));
  }

  const RgbdCalibration& calibration() const override { return calibration_; }

  std::optional<DeviceFrame> next_frame() override {
    if (next_ == pairs_.size()) return std::nullopt;
    const Pairer::Pair& pair = pairs_[next_++];
    try {
      DeviceFrame frame{.raw_disparity = {},
                        .color = images_.color(pair.color),
                        .depth_timestamp_us = pair.depth_us,
                        .color_timestamp_us = pair.color_us,
                        .depth = images_.depth(pair.depth)};
      require_size(frame.depth, calibration_.ir, "depth", pair.depth_us);
      require_size(frame.color, calibration_.rgb, "color", pair.color_us);
      return frame;
    } catch (const Error& e) {
      throw FrameError(e.what());
    }
  }

  int frame_count() const { return static_cast<int>(pairs_.size()); }
  int dropped() const { return dropped_; }

 private:
  template <typename Pixel>
  void require_size(const Image<Pixel>& image, const PinholeCamera& camera, const char* kind, int64_t us) const {
    if (image.width() != camera.width || image.height() != camera.height)
      throw Error(where_, fmt::format("{} image at {:.6f} s", kind, 1e-6 * static_cast<double>(us)),
                  fmt::format("{}x{}", image.width(), image.height()),
                  fmt::format("{}x{} as calibrated", camera.width, camera.height));
  }

  std::string where_;
  RgbdCalibration calibration_;
  RecordedImages images_;
  std::vector<Pairer::Pair> pairs_;
  size_t next_ = 0;
  int dropped_ = 0;
};

}  // namespace

TrackSource paired_source(const std::string& where, const RgbdCalibration& calibration, RecordedImages images,
                          int64_t max_gap_us) {
  auto device = std::make_unique<PairedRecording>(where, calibration, std::move(images), max_gap_us);
  const int frames = device->frame_count(), dropped = device->dropped();
  return recorded_source(std::move(device), frames, [dropped] { return dropped; });
}

RgbdCalibration registered_to_color(const RgbdCalibration& calibration) {
  RgbdCalibration registered;
  registered.ir = registered.rgb = calibration.rgb;
  registered.ir_lens = registered.rgb_lens = calibration.rgb_lens;
  return registered;
}

DepthImage depth_in_m(const Image<uint16_t>& steps, double steps_per_m) {
  DepthImage depth(steps.width(), steps.height());
  std::ranges::transform(steps, depth.begin(),
                         [&](uint16_t step) { return static_cast<float>(step / steps_per_m); });
  return depth;
}

}  // namespace glovebench::eval
