#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/image.h"

namespace glovebench {

enum class RecordedKind : char { depth = 'd', color = 'r', accelerometer = 'a' };

struct RecordedName {
  RecordedKind kind = RecordedKind::depth;
  int64_t timestamp_us = 0;
  uint32_t ticks = 0;  ///< as read; `recorded_name` computes its own
};

/// "d-12.000345-720020700.pgm"; time stamps >= 0.
std::string recorded_name(const RecordedName& name);
/// Throws: Error unless the name has this form, with any ticks.
RecordedName parse_recorded_name(std::string_view name, const std::string& where);

std::string encode_pgm(const Image<uint16_t>& raw_disparity);
std::string encode_ppm(const ColorImage& color);

/// Throws: Error unless the content is exactly one image of that size (11-bit disparity); also `decode_ppm`.
Image<uint16_t> decode_pgm(std::string_view content, int width, int height, const std::string& path);
ColorImage decode_ppm(std::string_view content, int width, int height, const std::string& path);

}  // namespace glovebench
