#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/database/field_rows.h"

namespace glovebench {

/// The labels of a tiny image as the kernels read them: whole chunks of 64 pixels, without a label behind the last.
struct QueryLabels {
  static constexpr size_t kChunk = 64;
  static constexpr size_t kLargest = 64 * 64;
  alignas(64) uint8_t labels[kLargest] = {};
};

/// 64 bytes of the field of one color, of which a query reads those where it has that color.
struct FieldChunk {
  uint32_t field;   ///< from the start of the entry's fields, bytes
  uint16_t pixels;  ///< first pixel of the query
  uint8_t color;
};

// The inner loops of the look-up, for the best instruction set of this processor (Highway). All give the same
// result.

/// For each entry of `field_rows` the weighted sum of these rows, 65535 if it is larger; `sums` has room for whole
/// blocks. `block_minima`: the least sum of each block.
void add_rows(const FieldRows& field_rows, std::span<const WeightedRow> rows, std::span<uint16_t> sums,
              std::span<uint16_t> block_minima);

/// The sum of what the query's chunks read, or any number above `limit` if the sum is above it. While it runs it
/// asks for the same chunks at `next`, which may be null. Reads up to 63 bytes behind an entry's fields.
uint32_t add_chunks(const uint8_t* fields, const QueryLabels& query, std::span<const FieldChunk> chunks,
                    uint32_t limit, const uint8_t* next);

}  // namespace glovebench
