#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/image.h"

namespace glovebench {

/// The files of a recording (see recording.h): names and images.
enum class RecordedKind : char { depth = 'd', color = 'r', accelerometer = 'a' };

struct RecordedName {
  RecordedKind kind = RecordedKind::depth;
  int64_t timestamp_us = 0;
  uint32_t ticks = 0;  ///< as read; recorded_name makes them of the time stamp
};

/// "d-12.000345-720020700.pgm". The time stamp must not be negative.
std::string recorded_name(const RecordedName& name);
/// Throws Error naming `where` and the name unless it is one that recorded_name could have made, but for the
/// ticks, which may be any.
RecordedName parse_recorded_name(std::string_view name, const std::string& where);

std::string encode_pgm(const Image<uint16_t>& raw_disparity);
std::string encode_ppm(const ColorImage& color);

/// Both throw Error naming `path` and the field (header, size, pixel) unless the content is exactly one image of
/// that size; disparity has at most 11 bits.
Image<uint16_t> decode_pgm(std::string_view content, int width, int height, const std::string& path);
ColorImage decode_ppm(std::string_view content, int width, int height, const std::string& path);

}  // namespace glovebench
