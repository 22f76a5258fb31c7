#include "core/kinect/recording_index.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/kinect/disparity.h"
#include "core/kinect/frame_pairer.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;

/// The times at which images were taken. Of all times that an image's ticks may mean, this is the nearest to its
/// arrival, corrected by the difference of the two clocks at the first image. So pauses may be longer than a round
/// of the ticks.
class TakenTimes {
 public:
  int64_t microseconds(const RecordedName& name) {
    const int64_t time_us = TickClock(name.timestamp_us + ahead_us_.value_or(0)).microseconds(name.ticks);
    if (!ahead_us_) ahead_us_ = time_us - name.timestamp_us;
    return time_us;
  }

 private:
  std::optional<int64_t> ahead_us_;  ///< device's clock minus computer's
};

/// The size of a file, 0 if there is none.
uintmax_t size_of(const std::string& path) {
  std::error_code error;
  const uintmax_t size = fs::file_size(path, error);
  return error ? 0 : size;
}

/// Throws: Error unless the file begins and ends where fakenect expects it.
void require_image(const std::string& path, const std::string& header, size_t bytes) {
  if (size_of(path) != header.size() + bytes)
    throw Error(path, "size", std::to_string(size_of(path)) + " bytes",
                std::to_string(header.size() + bytes) + " of an image of 640x480");
  std::string start(header.size(), '\0');
  std::ifstream(path, std::ios::binary).read(start.data(), static_cast<std::streamsize>(start.size()));
  if (start != header)
    throw Error(path, "header", "something else", "\"" + header.substr(0, header.size() - 1) + "\"");
}

}  // namespace

std::string path_in_recording(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

std::vector<RecordingEntry> parse_recording_index(std::string_view content, const std::string& folder) {
  const std::string index = path_in_recording(folder, kRecordingIndex);
  std::vector<RecordingEntry> entries;
  std::vector<std::string_view> listed;
  // Reserves room for no more lines than the content can hold, since an entry is larger than its line.
  constexpr size_t kShortestLine = std::string_view("d-0.000000-0.pgm\n").size();
  entries.reserve(content.size() / kShortestLine + 1);
  listed.reserve(entries.capacity());
  TakenTimes times;
  for (int number = 1; !content.empty(); ++number) {
    const std::string_view line = content.substr(0, content.find('\n'));
    content.remove_prefix(std::min(line.size() + 1, content.size()));
    const RecordedName name = parse_recorded_name(line, index + ", line " + std::to_string(number));
    if (name.kind == RecordedKind::accelerometer) continue;
    listed.push_back(line);
    entries.push_back({name.kind, times.microseconds(name), std::string(line)});
  }
  std::ranges::sort(listed);
  if (const auto twice = std::ranges::adjacent_find(listed); twice != listed.end())
    throw Error(index, "file name", std::string(*twice) + " twice", "each once");
  const auto key = [](const RecordingEntry& entry) { return std::pair(entry.timestamp_us, entry.kind); };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const RecordingEntry& a, const RecordingEntry& b) { return key(a) < key(b); });
  return entries;
}

void check_fakenect_dump(const std::string& folder) {
  constexpr size_t kPixels = 640 * 480;
  const std::string index = path_in_recording(folder, kRecordingIndex);
  std::istringstream lines(read_regular_file(index, kLargestIndex));
  int depths = 0;
  for (std::string line; std::getline(lines, line);) {
    const RecordedKind kind = parse_recorded_name(line, index).kind;
    const std::string path = path_in_recording(folder, line);
    depths += kind == RecordedKind::depth;
    if (kind == RecordedKind::depth) require_image(path, "P5 640 480 65535\n", 2 * kPixels);
    if (kind == RecordedKind::color) require_image(path, "P6 640 480 255\n", 3 * kPixels);
    if (size_of(path) == 0) throw Error(path, "file", "nothing", "what the index lists");
  }
  if (depths == 0) throw Error(index, "depth images", "none", "at least one");
}

}  // namespace glovebench
