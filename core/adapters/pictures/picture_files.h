#pragma once

#include <string>
#include <string_view>

#include "core/base/image.h"

namespace glovebench {

/// The bytes of a PNG file.
std::string encode_png(const ColorImage& image);
/// The bytes of a JPEG file. `quality`: 1 to 100.
std::string encode_jpeg(const ColorImage& image, int quality);

/// Decode PNG, JPEG, binary PGM or binary PPM. `path` names the file in messages. Gray of 16 bits is stretched to
/// 8, because a sensor uses only a part of the 16. Throws: Error unless it is one whole image of at most
/// kMostPixels.
ColorImage decode_color(std::string_view content, const std::string& path);
Image<uint8_t> decode_gray(std::string_view content, const std::string& path);

}  // namespace glovebench
