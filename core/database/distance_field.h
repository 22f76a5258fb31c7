#pragma once

#include <cstdint>
#include <span>

#include "core/base/image.h"

namespace glovebench {

/// Distances are in 1/kFieldScale px: 3 for a straight step, 4 for a diagonal one.
inline constexpr int kFieldScale = 3;

/// Distances to `color` by two-pass chamfering, at most `cap`.
/// Paper: section III-B.
void chamfer_field_plain(const LabelImage& labels, uint8_t color, uint8_t cap, std::span<uint8_t> field);

/// Half-open.
struct RowRange {
  int first = 0, last = 0;
};

/// The same, faster.
void chamfer_field(const LabelImage& labels, uint8_t color, uint8_t cap, std::span<uint8_t> field);
/// Only rows `wanted`.
void chamfer_field(const LabelImage& labels, uint8_t color, uint8_t cap, std::span<uint8_t> field, RowRange wanted);
/// The fields of all colors in turn.
void chamfer_fields(const LabelImage& labels, uint8_t cap, std::span<uint8_t> fields);

}  // namespace glovebench
