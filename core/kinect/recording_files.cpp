#include "core/kinect/recording_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/text.h"
#include "core/kinect/disparity.h"
#include "core/kinect/frame_pairer.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;

constexpr int64_t kMicros = 1'000'000;
constexpr size_t kMaxSecondDigits = 11;  // as ticks they still fit 64 bits

std::string_view extension(RecordedKind kind) {
  if (kind == RecordedKind::depth) return "pgm";
  return kind == RecordedKind::color ? "ppm" : "dump";
}

/// Reads a name from left to right; each step fails on unexpected text.
class NameReader {
 public:
  NameReader(std::string_view name, const std::string& where) : name_(name), rest_(name), where_(where) {}

  [[noreturn]] void fail() const {
    throw Error(where_, "file name", "\"" + printable(name_) + "\"", "TYPE-SECONDS.MICROS-TICKS.EXTENSION");
  }
  void expect(std::string_view text) {
    if (!rest_.starts_with(text)) fail();
    rest_.remove_prefix(text.size());
  }
  RecordedKind kind() {
    const char letter = rest_.empty() ? '\0' : rest_.front();
    if (letter != 'd' && letter != 'r' && letter != 'a') fail();
    rest_.remove_prefix(1);
    return static_cast<RecordedKind>(letter);
  }
  int64_t digits(size_t min_count, size_t max_count) {
    const size_t count = std::min(rest_.find_first_not_of("0123456789"), rest_.size());
    if (count < min_count || count > max_count) fail();
    int64_t value = 0;
    std::from_chars(rest_.data(), rest_.data() + count, value);
    rest_.remove_prefix(count);
    return value;
  }
  void end() const {
    if (!rest_.empty()) fail();
  }

 private:
  std::string_view name_, rest_;
  const std::string& where_;
};

std::string netpbm_header(std::string_view magic, int width, int height, int max_value) {
  return fmt::format("{} {} {} {}\n", magic, width, height, max_value);
}

/// The pixels behind the expected header, in which white space may differ. Checked before any image is allocated,
/// whatever size the file claims.
std::string_view payload(std::string_view content, const std::string& header, size_t bytes,
                         const std::string& path) {
  const auto is_space = [](char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; };
  bool equal = content.size() >= header.size();
  for (size_t i = 0; equal && i < header.size(); ++i)
    equal = is_space(header[i]) ? is_space(content[i]) : content[i] == header[i];
  if (!equal)
    throw Error(path, "header", content.empty() ? "an empty file" : "something else",
                "\"" + header.substr(0, header.size() - 1) + "\"");
  const std::string_view pixels = content.substr(header.size());
  if (pixels.size() != bytes)
    throw Error(path, "size", fmt::format("{} bytes of pixels", pixels.size()), fmt::format("{}", bytes));
  return pixels;
}

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

std::string recorded_name(const RecordedName& name) {
  check(name.timestamp_us >= 0, "a recorded time stamp is not negative");
  const uint32_t ticks = static_cast<uint32_t>(static_cast<uint64_t>(name.timestamp_us) * kTicksPerMicrosecond);
  return fmt::format("{}-{}.{:06}-{}.{}", static_cast<char>(name.kind), name.timestamp_us / kMicros,
                     name.timestamp_us % kMicros, ticks, extension(name.kind));
}

RecordedName parse_recorded_name(std::string_view name, const std::string& where) {
  NameReader reader(name, where);
  RecordedName parsed;
  parsed.kind = reader.kind();
  reader.expect("-");
  const int64_t seconds = reader.digits(1, kMaxSecondDigits);
  reader.expect(".");
  parsed.timestamp_us = seconds * kMicros + reader.digits(6, 6);
  reader.expect("-");
  const int64_t ticks = reader.digits(1, 10);
  if (ticks > std::numeric_limits<uint32_t>::max()) reader.fail();
  parsed.ticks = static_cast<uint32_t>(ticks);
  reader.expect(".");
  reader.expect(extension(parsed.kind));
  reader.end();
  return parsed;
}

std::string encode_pgm(const Image<uint16_t>& raw_disparity) {
  // Little-endian as fakenect writes it, although the format says big-endian.
  std::string content = netpbm_header("P5", raw_disparity.width(), raw_disparity.height(), 65535);
  content.reserve(content.size() + 2 * raw_disparity.size());
  for (uint16_t raw : raw_disparity) {
    content.push_back(static_cast<char>(raw & 255));
    content.push_back(static_cast<char>(raw >> 8));
  }
  return content;
}

std::string encode_ppm(const ColorImage& color) {
  std::string content = netpbm_header("P6", color.width(), color.height(), 255);
  content.reserve(content.size() + 3 * color.size());
  for (const Rgb& rgb : color)
    for (uint8_t channel : rgb) content.push_back(static_cast<char>(channel));
  return content;
}

Image<uint16_t> decode_pgm(std::string_view content, int width, int height, const std::string& path) {
  const size_t bytes = 2 * static_cast<size_t>(width) * static_cast<size_t>(height);
  const std::string_view pixels = payload(content, netpbm_header("P5", width, height, 65535), bytes, path);
  Image<uint16_t> image(width, height);
  for (size_t i = 0; i < image.size(); ++i) {
    const int low = static_cast<uint8_t>(pixels[2 * i]), high = static_cast<uint8_t>(pixels[2 * i + 1]);
    image[i] = static_cast<uint16_t>(low | high << 8);
    if (image[i] > kNoDisparity)
      throw Error(path, fmt::format("pixel ({}, {})", i % width, i / width), std::to_string(image[i]),
                  "11 bits, at most 2047");
  }
  return image;
}

ColorImage decode_ppm(std::string_view content, int width, int height, const std::string& path) {
  const size_t bytes = 3 * static_cast<size_t>(width) * static_cast<size_t>(height);
  const std::string_view pixels = payload(content, netpbm_header("P6", width, height, 255), bytes, path);
  ColorImage image(width, height);
  for (size_t i = 0; i < image.size(); ++i)
    for (size_t channel = 0; channel < 3; ++channel)
      image[i][channel] = static_cast<uint8_t>(pixels[3 * i + channel]);
  return image;
}

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
