#pragma once

#include <cstdint>
#include <span>

#include "core/base/image.h"

namespace glovebench {

/// Stored distances count in steps of 1/kFieldScale px: a chamfer 3-4 step to a neighbor is 3, to a diagonal
/// one 4.
inline constexpr int kFieldScale = 3;

/// The distance field of one color by chamfering (section III-B): for each pixel the distance to the nearest pixel
/// of that color, capped; `cap` everywhere if the color is absent. Units: 1/kFieldScale px. `field` has the image's
/// size. Two passes over the image, as chamfering is described.
void chamfer_field_plain(const LabelImage& labels, uint8_t color, uint8_t cap, std::span<uint8_t> field);

/// Rows of an image: from the first up to, not including, the last.
struct RowRange {
  int first = 0, last = 0;
};

/// The same field, faster: a shortest path runs diagonally or vertically first and horizontally last, so that whole
/// rows can be relaxed at once.
void chamfer_field(const LabelImage& labels, uint8_t color, uint8_t cap, std::span<uint8_t> field);
/// The same, but of these rows alone: others of `field` get any values.
void chamfer_field(const LabelImage& labels, uint8_t color, uint8_t cap, std::span<uint8_t> field, RowRange wanted);
/// The fields of all colors, one behind the other: kColorCount times the image's size.
void chamfer_fields(const LabelImage& labels, uint8_t cap, std::span<uint8_t> fields);

}  // namespace glovebench
