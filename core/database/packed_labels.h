#pragma once

#include <span>

#include "core/base/image.h"

namespace glovebench {

/// Labels at 4 bits a pixel: two pixels a byte, the earlier one in its low half.
constexpr size_t packed_bytes(size_t pixels) {
  return (pixels + 1) / 2;
}
/// `packed` has `packed_bytes` of the image's pixels; every label is below 16.
void pack_labels(const LabelImage& labels, std::span<uint8_t> packed);
LabelImage unpack_labels(std::span<const uint8_t> packed, int width, int height);

}  // namespace glovebench
