#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/database/field_rows.h"

namespace glovebench {

/// A query's labels, padded by 0.
struct QueryLabels {
  static constexpr size_t kChunk = 64;
  static constexpr size_t kLargest = 64 * 64;
  alignas(64) uint8_t labels[kLargest] = {};
};

/// 64 bytes of a field, with query pixels of its color.
struct FieldChunk {
  uint32_t field;   ///< from the entry's first field, bytes
  uint16_t pixels;  ///< first pixel of the query
  uint8_t color;
};

// Inner loops (Highway). All instruction sets give equal results.

/// Weighted sums of rows by entry, at most 65535, and each block's minimum. `sums` has room for whole blocks.
void add_rows(const FieldRows& field_rows, std::span<const WeightedRow> rows, std::span<uint16_t> sums,
              std::span<uint16_t> block_minima);

/// The sum over chunks; if above `limit`, any number above it. Prefetches `next` unless null. Reads up to 63 bytes
/// behind fields.
uint32_t add_chunks(const uint8_t* fields, const QueryLabels& query, std::span<const FieldChunk> chunks,
                    uint32_t limit, const uint8_t* next);

}  // namespace glovebench
