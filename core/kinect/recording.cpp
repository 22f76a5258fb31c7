#include "core/kinect/recording.h"

#include <algorithm>
#include <filesystem>

#include "core/base/error.h"
#include "core/kinect/disparity.h"
#include "core/kinect/recording_files.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCalibration = "calibration.json";

void require_size(int width, int height, const PinholeCamera& camera, const std::string& field) {
  if (width != camera.width || height != camera.height)
    throw Error("recording", field, std::to_string(width) + "x" + std::to_string(height),
                std::to_string(camera.width) + "x" + std::to_string(camera.height) + " as calibrated");
}

/// More bytes than a valid file of such an image has: a larger file is read no further, and decoding refuses it.
uint64_t largest_image(const PinholeCamera& camera) {
  constexpr uint64_t kBytesPerPixel = 4, kOthers = 4096;
  return kBytesPerPixel * static_cast<uint64_t>(camera.width * camera.height) + kOthers;
}

}  // namespace

RecordingDevice::RecordingDevice(const std::string& folder, const std::optional<RgbdCalibration>& calibration)
    : files_(folder) {
  const std::string index = files_.path(kRecordingIndex), own = files_.path(kCalibration);
  calibration_ =
      calibration ? *calibration : calibration_from_text(read_text(kCalibration, kLargestCalibration), own);
  FramePairer<std::string, std::string> pairer;
  int depths = 0, colors = 0;
  const auto take_pairs = [&] {
    while (std::optional<Pair> pair = pairer.pop()) pairs_.push_back(std::move(*pair));
  };
  for (RecordingEntry& entry : parse_recording_index(read_text(kRecordingIndex, kLargestIndex), folder)) {
    const bool is_depth = entry.kind == RecordedKind::depth;
    ++(is_depth ? depths : colors);
    if (is_depth) pairer.push_depth(entry.timestamp_us, std::move(entry.name));
    if (!is_depth) pairer.push_color(entry.timestamp_us, std::move(entry.name));
    take_pairs();
  }
  pairer.finish();
  take_pairs();
  unpaired_depth_count_ = pairer.unpaired();
  repeated_count_ = pairer.went_back();
  if (pairs_.empty())
    throw Error(index, "frames", std::to_string(depths) + " depth and " + std::to_string(colors) + " color images",
                "at least one pair within 50 ms");
}

std::optional<DeviceFrame> RecordingDevice::next_frame() {
  if (next_ == pairs_.size()) return std::nullopt;
  const Pair& pair = pairs_[next_++];
  const PinholeCamera &ir = calibration_.ir, &rgb = calibration_.rgb;
  try {
    const FileSet::Found depth = files_.find(pair.depth, largest_image(ir)),
                         color = files_.find(pair.color, largest_image(rgb));
    DeviceFrame frame{.raw_disparity = decode_pgm(depth.content, ir.width, ir.height, files_.path(pair.depth)),
                      .color = decode_ppm(color.content, rgb.width, rgb.height, files_.path(pair.color)),
                      .depth_timestamp_us = pair.depth_us,
                      .color_timestamp_us = pair.color_us};
    if (depth.is_changed) files_.refuse(pair.depth);
    if (color.is_changed) files_.refuse(pair.color);
    return frame;
  } catch (const Error& e) {
    throw FrameError(e.what());
  }
}

std::string RecordingDevice::read_text(const std::string& name, uint64_t max_bytes) {
  FileSet::Found found = files_.find(name, max_bytes);
  if (found.is_changed) changed_.push_back(name);
  return std::move(found.content);
}

RecordingWriter::RecordingWriter(const std::string& folder, const RgbdCalibration& calibration)
    : files_(folder), folder_(folder), calibration_(calibration) {
  if (fs::exists(path_in_recording(folder, kRecordingIndex)))
    throw Error(folder, kRecordingIndex, "a recording", "a folder without one");
  files_.add(kCalibration, calibration_text(calibration));
}

void RecordingWriter::write(const DeviceFrame& frame) {
  require_size(frame.raw_disparity.width(), frame.raw_disparity.height(), calibration_.ir, "raw_disparity");
  require_size(frame.color.width(), frame.color.height(), calibration_.rgb, "color");
  const auto highest = std::max_element(frame.raw_disparity.begin(), frame.raw_disparity.end());
  if (*highest > kNoDisparity)
    throw Error("recording", "raw_disparity", std::to_string(*highest), "11 bits, at most 2047");
  const auto require_time = [](const char* field, int64_t timestamp_us, int64_t least) {
    if (timestamp_us < least)
      throw Error("recording", field, std::to_string(timestamp_us), "at least " + std::to_string(least));
  };
  require_time("depth_timestamp_us", frame.depth_timestamp_us, last_depth_us_ + 1);
  require_time("color_timestamp_us", frame.color_timestamp_us, std::max<int64_t>(last_color_us_, 0));

  const std::string depth = recorded_name({RecordedKind::depth, frame.depth_timestamp_us});
  files_.add(depth, encode_pgm(frame.raw_disparity));
  index_.emplace_back(frame.depth_timestamp_us, depth);
  last_depth_us_ = frame.depth_timestamp_us;
  if (frame.color_timestamp_us == last_color_us_) return;
  const std::string color = recorded_name({RecordedKind::color, frame.color_timestamp_us});
  files_.add(color, encode_ppm(frame.color));
  index_.emplace_back(frame.color_timestamp_us, color);
  last_color_us_ = frame.color_timestamp_us;
}

void RecordingWriter::finish() {
  if (index_.empty()) throw Error(folder_, "frames", "none", "at least one");
  std::sort(index_.begin(), index_.end());
  std::string content;
  for (const auto& [timestamp_us, name] : index_) content += name + "\n";
  files_.add(kRecordingIndex, content);
  files_.commit();
}

}  // namespace glovebench
