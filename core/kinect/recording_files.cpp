#include "core/kinect/recording_files.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/kinect/disparity.h"
#include "core/kinect/frame_pairer.h"

namespace glovebench {
namespace {

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

}  // namespace glovebench
