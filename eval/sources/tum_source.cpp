#include "eval/sources/tum_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/adapters/pictures/picture_files.h"
#include "core/base/error.h"
#include "core/base/file_set.h"
#include "core/base/text.h"
#include "core/kinect/recording_files.h"
#include "eval/sources/paired_recording.h"
#include "trajectories/text_cells.h"

namespace glovebench::eval {
namespace {

constexpr double kSteps_per_m = 5000;
constexpr int64_t kMaxGap_us = 20'000;  // of the benchmark's own associate.py
constexpr const char* kCalibration = "calibration.json";

/// More bytes than a PNG file of such an image needs.
uint64_t largest_file(const PinholeCamera& camera) {
  return 4 * static_cast<uint64_t>(camera.width * camera.height) + (uint64_t{1} << 16);
}

/// The files of a folder, whose manifest tells the damaged ones.
class TumFolder {
 public:
  explicit TumFolder(const std::string& folder) : files_(folder) {}

  std::vector<TumImage> list(const std::string& name) {
    return parse_tum_list(text(name, kLargestIndex), files_.path(name));
  }
  RgbdCalibration calibration() {
    if (!files_.has(kCalibration))
      throw Error(files_.path(kCalibration), "file", "none", "the color camera's calibration, or --calibration");
    return calibration_from_text(text(kCalibration, kLargestCalibration), files_.path(kCalibration));
  }
  const std::vector<std::string>& changed() const { return changed_; }
  std::string image(const std::string& name, const PinholeCamera& camera) const {
    FileSet::Found found = files_.find(name, largest_file(camera));
    if (found.is_changed) files_.refuse(name);
    return std::move(found.content);
  }
  std::string path(const std::string& name) const { return files_.path(name); }

 private:
  std::string text(const std::string& name, uint64_t max_bytes) {
    FileSet::Found found = files_.find(name, max_bytes);
    if (found.is_changed) changed_.push_back(name);
    return std::move(found.content);
  }

  FileSet files_;
  std::vector<std::string> changed_;
};

std::vector<int64_t> times_of(const std::vector<TumImage>& images) {
  std::vector<int64_t> times_us;
  times_us.reserve(images.size());
  for (const TumImage& image : images) times_us.push_back(image.timestamp_us);
  return times_us;
}

TrackSource open_tum(const std::string& path, const SourceFlags& flags, bool quiet) {
  const auto folder = std::make_shared<TumFolder>(path);
  const RgbdCalibration calibration =
      registered_to_color(flags.calibration.empty() ? folder->calibration() : load_calibration(flags.calibration));
  const std::vector<TumImage> depths = folder->list("depth.txt"), colors = folder->list("rgb.txt");
  say_changed(flags.source, folder->changed(), quiet);
  const PinholeCamera camera = calibration.rgb;
  RecordedImages images{times_of(depths), times_of(colors),
                        [folder, camera, depths](size_t i) {
                          const std::string& name = depths[i].name;
                          return depth_in_m(decode_deep(folder->image(name, camera), folder->path(name)),
                                            kSteps_per_m);
                        },
                        [folder, camera, colors](size_t i) {
                          const std::string& name = colors[i].name;
                          return decode_color(folder->image(name, camera), folder->path(name));
                        }};
  return paired_source(path, calibration, std::move(images), kMaxGap_us);
}

}  // namespace

std::vector<TumImage> parse_tum_list(std::string_view text, const std::string& where) {
  constexpr double kLatest_s = 1e10;
  std::vector<TumImage> images;
  constexpr size_t kShortestLine = 4;  // "0 a\n"
  images.reserve(std::min<size_t>(std::ranges::count(text, '\n'), text.size() / kShortestLine) + 1);
  trajectories::Lines lines(text);
  while (const auto line = lines.next()) {
    if (line->empty() || line->front() == '#') continue;
    const std::string field = fmt::format("line {}", lines.number());
    const size_t blank = line->find_first_of(" \t");
    if (blank == std::string_view::npos) throw Error(where, field, quoted_excerpt(*line), "a time (s) and a file");
    const std::string name(trajectories::trimmed(line->substr(blank)));
    const double time_s = trajectories::number_from(line->substr(0, blank), 0, kLatest_s, where, field);
    path_within(where, name);
    images.push_back({std::llround(1e6 * time_s), name});
  }
  return images;
}

SourceKind tum_source() { return {"tum", "tum:FOLDER", "like the TUM RGB-D benchmark", open_tum}; }

}  // namespace glovebench::eval
