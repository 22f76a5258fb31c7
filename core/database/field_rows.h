#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/enum_names.h"
#include "core/base/image.h"
#include "core/base/mapped_memory.h"

namespace glovebench {

/// A database holds the labels of each view. `normal`: it also holds the distance fields, and in memory their least
/// values over 4 x 4 pixels. `low`: in memory it holds the least values over up to 8 x 8 pixels alone, and a
/// look-up makes the fields of the labels. The matches are the same.
enum class DatabaseMemory { normal, low };
constexpr auto names_of(DatabaseMemory) {
  return std::to_array<std::string_view>({"normal", "low"});
}

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

  /// Rows of tiny images of that size, px, until `put` all zero. `largest_value`: no field has a larger one.
  FieldRows(int size, DatabaseMemory memory, int entry_count, uint8_t largest_value);
  /// Writes what the rows hold of some entries from `first` on, of each kColorCount fields of size * size.
  /// Different entries may be put at once. The last one also fills what lies behind it in its block: nothing there
  /// is nearer than every entry.
  void put(int first, std::span<const uint8_t> fields);

  /// Sums over rows are the distances, not just bounds.
  bool exact() const { return pool_ == 1; }
  size_t block_count() const { return block_count_; }
  /// Of a block: kColorCount times as many as there are cells.
  size_t row_count() const { return static_cast<size_t>(kColorCount) * cells_ * cells_; }
  size_t block_bytes() const { return row_count() * kBlock; }
  const uint8_t* data() const { return values_.bytes().data(); }
  uint8_t largest_value() const { return largest_value_; }

  /// The rows that a query of this size adds up: how many of its pixels of a color lie in a cell.
  RecycledVector<WeightedRow> rows_of(const LabelImage& query) const;
  /// The weighted sum of these rows for one entry.
  uint32_t sum(int entry, std::span<const WeightedRow> rows) const;

 private:
  int size_;  ///< px
  int entry_count_;
  int pool_;                                 ///< px
  int cells_;                                ///< a side
  std::array<uint8_t, 64> cell_of_pixel_{};  ///< along a side
  size_t block_count_;
  uint8_t largest_value_;
  MappedMemory values_;  ///< in large pages: rows are read here and there
};

}  // namespace glovebench
