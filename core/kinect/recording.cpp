#include "core/kinect/recording.h"

#include <algorithm>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/kinect/disparity.h"
#include "core/kinect/recording_files.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;

std::string in_folder(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// Throws Error if two entries have one time stamp; they are sorted.
template <typename Entries>
void require_distinct(const Entries& entries, const std::string& where) {
  const auto same = [](const auto& a, const auto& b) { return a.timestamp_us == b.timestamp_us; };
  const auto twice = std::adjacent_find(entries.begin(), entries.end(), same);
  if (twice != entries.end())
    throw Error(where, "time stamp", std::to_string(twice->timestamp_us) + " us twice", "each once");
}

void require_size(int width, int height, const PinholeCamera& camera, const std::string& field) {
  if (width != camera.width || height != camera.height)
    throw Error("recording", field, std::to_string(width) + "x" + std::to_string(height),
                std::to_string(camera.width) + "x" + std::to_string(camera.height) + " as calibrated");
}

}  // namespace

RecordingDevice::RecordingDevice(const std::string& folder)
    : calibration_(load_calibration(in_folder(folder, "calibration.json"))) {
  const std::string index = in_folder(folder, "INDEX.txt");
  const std::string content = read_file(index);
  std::vector<Entry> depths, colors;
  int number = 0;
  for (std::string_view line : lines_of(content)) {
    const RecordedName name = parse_recorded_name(line, index + ", line " + std::to_string(++number));
    Entry entry{in_folder(folder, std::string(line)), name.timestamp_us};
    if (name.kind == RecordedKind::depth) depths.push_back(std::move(entry));
    if (name.kind == RecordedKind::color) colors.push_back(std::move(entry));
  }
  for (std::vector<Entry>* entries : {&depths, &colors}) {
    std::sort(entries->begin(), entries->end(),
              [](const Entry& a, const Entry& b) { return a.timestamp_us < b.timestamp_us; });
    require_distinct(*entries, index);
  }
  pair_by_time(depths, colors);
  if (pairs_.empty())
    throw Error(index, "frames",
                std::to_string(depths.size()) + " depth and " + std::to_string(colors.size()) + " color images",
                "at least one pair within 50 ms");
}

void RecordingDevice::pair_by_time(const std::vector<Entry>& depths, const std::vector<Entry>& colors) {
  for (const Entry& depth : depths) {
    const auto gap = [&](const Entry& color) { return std::abs(color.timestamp_us - depth.timestamp_us); };
    const auto is_before = [](const Entry& color, int64_t time_us) { return color.timestamp_us < time_us; };
    auto nearest = std::lower_bound(colors.begin(), colors.end(), depth.timestamp_us, is_before);
    if (nearest != colors.begin() && (nearest == colors.end() || gap(*std::prev(nearest)) <= gap(*nearest)))
      --nearest;
    if (nearest == colors.end() || gap(*nearest) > kMaxPairGap_us) {
      ++unpaired_depth_count_;
      continue;
    }
    pairs_.push_back({depth, *nearest});
  }
}

std::optional<DeviceFrame> RecordingDevice::next_frame() {
  if (next_ == pairs_.size()) return std::nullopt;
  const Pair& pair = pairs_[next_++];
  DeviceFrame frame;
  frame.raw_disparity =
      decode_pgm(read_file(pair.depth.path), calibration_.ir.width, calibration_.ir.height, pair.depth.path);
  frame.color =
      decode_ppm(read_file(pair.color.path), calibration_.rgb.width, calibration_.rgb.height, pair.color.path);
  frame.depth_timestamp_us = pair.depth.timestamp_us;
  frame.color_timestamp_us = pair.color.timestamp_us;
  return frame;
}

RecordingWriter::RecordingWriter(const std::string& folder, const RgbdCalibration& calibration)
    : folder_(folder), calibration_(calibration) {
  if (fs::exists(in_folder(folder, "INDEX.txt")))
    throw Error(folder, "INDEX.txt", "a recording", "a folder without one");
  save_calibration(calibration, in_folder(folder, "calibration.json"));
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
  write_file(in_folder(folder_, depth), encode_pgm(frame.raw_disparity));
  index_.emplace_back(frame.depth_timestamp_us, depth);
  last_depth_us_ = frame.depth_timestamp_us;
  if (frame.color_timestamp_us == last_color_us_) return;
  const std::string color = recorded_name({RecordedKind::color, frame.color_timestamp_us});
  write_file(in_folder(folder_, color), encode_ppm(frame.color));
  index_.emplace_back(frame.color_timestamp_us, color);
  last_color_us_ = frame.color_timestamp_us;
}

void RecordingWriter::finish() {
  if (index_.empty()) throw Error(folder_, "frames", "none", "at least one");
  std::sort(index_.begin(), index_.end());
  std::string content;
  for (const auto& [timestamp_us, name] : index_) content += name + "\n";
  write_file(in_folder(folder_, "INDEX.txt"), content);
}

}  // namespace glovebench
