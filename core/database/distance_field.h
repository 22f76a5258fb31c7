#pragma once

#include <cstdint>
#include <span>

#include "core/base/image.h"

namespace glovebench {

/// Stored distances are in 1/kFieldScale px: a straight chamfer step is 3, a diagonal one 4.
inline constexpr int kFieldScale = 3;

/// Computes the distance of each pixel to the nearest one of `color` by two-pass chamfering, at most `cap`, also if
/// the color is absent.
/// Paper: section III-B.
void chamfer_field_plain(const LabelImage& labels, uint8_t color, uint8_t cap, std::span<uint8_t> field);

/// `last` is excluded.
struct RowRange {
  int first = 0, last = 0;
};

/// The same, faster: relaxes whole rows at once.
void chamfer_field(const LabelImage& labels, uint8_t color, uint8_t cap, std::span<uint8_t> field);
/// The same for the rows `wanted`; other values are undefined.
void chamfer_field(const LabelImage& labels, uint8_t color, uint8_t cap, std::span<uint8_t> field, RowRange wanted);
/// The fields of all colors, one behind the other.
void chamfer_fields(const LabelImage& labels, uint8_t cap, std::span<uint8_t> fields);

}  // namespace glovebench
