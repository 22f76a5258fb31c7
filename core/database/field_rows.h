#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/image.h"
#include "core/database/database_memory.h"

namespace glovebench {

/// A row that a query adds up, and how often.
struct WeightedRow {
  uint32_t row;
  uint16_t weight;
};

/// The distance fields of one size once more, for a look at all entries at once: blocks of 64 entries, in a block a
/// row for each color and cell, in a row the values of the block's entries side by side. A cell of small images is
/// a pixel; one of larger images is 4 x 4 pixels (8 x 8 of those above 32 px in a low-memory database) and has the
/// least of their values, so that sums over cells are lower bounds of sums over pixels.
class FieldRows {
 public:
  static constexpr int kBlock = 64;            ///< entries: a row is a cache line
  static constexpr int kLargestExact = 24;     ///< px
  static constexpr int kLargestFinePool = 32;  ///< px

  FieldRows() = default;
  /// Rows of tiny images of that size, px, as `put` and `repeat_last_entry` made them in `values`, whose lifetime
  /// is the caller's concern; without values just their shape.
  FieldRows(int size, DatabaseMemory memory, int entry_count, std::span<const uint8_t> values = {});
  /// What the rows take.
  size_t bytes() const { return block_count() * block_bytes(); }
  /// Writes what the rows hold of one entry, whose kColorCount fields of size * size these are, into `values`.
  /// Entries may be put in any order, and at once.
  void put(int entry, const uint8_t* fields, std::span<uint8_t> values) const;
  /// Fills what lies behind the last entry in its block, so that nothing there is nearer than every entry.
  void repeat_last_entry(std::span<uint8_t> values) const;

  /// Sums over rows are the distances, not just bounds.
  bool exact() const { return pool_ == 1; }
  size_t block_count() const { return block_count_; }
  /// Of a block: kColorCount times as many as there are cells.
  size_t row_count() const { return static_cast<size_t>(kColorCount) * cells_ * cells_; }
  size_t block_bytes() const { return row_count() * kBlock; }
  const uint8_t* data() const { return values_.data(); }
  uint8_t largest_value() const { return largest_value_; }

  /// The rows that a query of this size adds up: how many of its pixels of a color lie in a cell.
  RecycledVector<WeightedRow> rows_of(const LabelImage& query) const;
  /// The weighted sum of these rows for one entry.
  uint32_t sum(int entry, std::span<const WeightedRow> rows) const;

 private:
  int size_ = 0;  ///< px
  int entry_count_ = 0;
  int pool_ = 1;                             ///< px
  int cells_ = 0;                            ///< a side
  std::array<uint8_t, 64> cell_of_pixel_{};  ///< along a side
  size_t block_count_ = 0;
  uint8_t largest_value_ = 0;
  std::span<const uint8_t> values_;  ///< entries behind the last one repeat it
};

}  // namespace glovebench
