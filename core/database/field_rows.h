#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/enum_names.h"
#include "core/base/image.h"
#include "core/base/mapped_memory.h"

namespace glovebench {

/// `low` stores no fields but makes them during a look-up, and pools up to 8 x 8 pixels, not 4 x 4. Matches are
/// equal.
enum class DatabaseMemory { normal, low };
constexpr auto names_of(DatabaseMemory) { return std::to_array<std::string_view>({"normal", "low"}); }

struct WeightedRow {
  uint32_t row;
  uint16_t weight;
};

/// One size's distance fields, arranged for a search over all entries: blocks of 64 entries, a row per color and
/// cell, a value per entry. In large images a cell is the minimum of 4 x 4 or 8 x 8 pixels; sums are then lower
/// bounds.
class FieldRows {
 public:
  static constexpr int kBlock = 64;            ///< entries: a cache line
  static constexpr int kLargestExact = 24;     ///< px; larger sizes hold minima
  static constexpr int kLargestFinePool = 32;  ///< px; larger sizes pool 8 x 8 in low memory

  /// Rows are 0 until `put`.
  FieldRows(int size, DatabaseMemory memory, int entry_count, uint8_t largest_value);
  /// Writes entries from `first` on, kColorCount * size * size values each. The last entry also fills its block.
  /// Threads may put different entries.
  void put(int first, std::span<const uint8_t> fields);

  /// True: sums are distances. False: lower bounds.
  bool exact() const { return pool_ == 1; }
  size_t block_count() const { return block_count_; }
  size_t row_count() const { return static_cast<size_t>(kColorCount) * cells_ * cells_; }
  size_t block_bytes() const { return row_count() * kBlock; }
  const uint8_t* data() const { return values_.bytes().data(); }
  uint8_t largest_value() const { return largest_value_; }

  /// Counts the query's pixels by color and cell.
  RecycledVector<WeightedRow> rows_of(const LabelImage& query) const;
  uint32_t sum(int entry, std::span<const WeightedRow> rows) const;

 private:
  int size_;
  int entry_count_;
  int pool_;  ///< px
  int cells_;
  std::array<uint8_t, 64> cell_of_pixel_{};
  size_t block_count_;
  uint8_t largest_value_;
  MappedMemory values_;
};

}  // namespace glovebench
