#pragma once

#include <string>
#include <string_view>

#include "core/base/image.h"

namespace glovebench {

/// Gray keeps its 8 or 16 bits.
std::string encode_png(const ColorImage& image);
std::string encode_png(const Image<uint8_t>& image);
std::string encode_png(const Image<uint16_t>& image);
/// `quality`: 1 to 100.
std::string encode_jpeg(const ColorImage& image, int quality);

/// Decode PNG, JPEG, binary PGM or PPM. `path` is for messages. 16-bit gray is stretched to 8.
/// Throws: Error unless the content is one whole image of at most kMostPixels.
ColorImage decode_color(std::string_view content, const std::string& path);
Image<uint8_t> decode_gray(std::string_view content, const std::string& path);
/// Numbers as stored: ignores a PNG file's color space and brightness.
/// Throws: Error likewise, and unless gray of 16 bits.
Image<uint16_t> decode_deep(std::string_view content, const std::string& path);

}  // namespace glovebench
