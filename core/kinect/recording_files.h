#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/image.h"

namespace glovebench {

enum class RecordedKind : char { depth = 'd', color = 'r', accelerometer = 'a' };

struct RecordedName {
  RecordedKind kind = RecordedKind::depth;
  int64_t timestamp_us = 0;
  uint32_t ticks = 0;  ///< as read; `recorded_name` computes it
};

/// "d-12.000345-720020700.pgm". Time stamps >= 0.
std::string recorded_name(const RecordedName& name);
/// Throws: Error unless the name has this form. Ticks may differ.
RecordedName parse_recorded_name(std::string_view name, const std::string& where);

std::string encode_pgm(const Image<uint16_t>& raw_disparity);
std::string encode_ppm(const ColorImage& color);

/// Throws: Error unless the content is one image of that size (disparity: 11 bits); also `decode_ppm`.
Image<uint16_t> decode_pgm(std::string_view content, int width, int height, const std::string& path);
ColorImage decode_ppm(std::string_view content, int width, int height, const std::string& path);

inline constexpr const char* kRecordingIndex = "INDEX.txt";
/// Bytes.
inline constexpr uint64_t kLargestIndex = uint64_t{64} << 20;

struct RecordingEntry {
  RecordedKind kind = RecordedKind::depth;
  int64_t timestamp_us = 0;  ///< by the device's clock
  std::string name;
};

std::string path_in_recording(const std::string& folder, const std::string& name);

/// Images by time. At equal times: depth first, then in the index's order.
/// Throws: Error if it is malformed or lists a file twice.
std::vector<RecordingEntry> parse_recording_index(std::string_view content, const std::string& folder);

/// Checks sizes and headers: a bad one would make fakenect end the program.
/// Throws: Error.
void check_fakenect_dump(const std::string& folder);

}  // namespace glovebench
