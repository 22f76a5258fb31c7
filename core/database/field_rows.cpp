#include "core/database/field_rows.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace glovebench {
namespace {

/// The least value of each cell of one entry: kColorCount fields of cells * cells.
void pool_entry(const uint8_t* fields, int size, int pool, int cells, uint8_t* minima) {
  std::fill_n(minima, static_cast<size_t>(kColorCount) * cells * cells, uint8_t{255});
  for (int color = 0; color < kColorCount; ++color) {
    uint8_t* const of_color = minima + static_cast<ptrdiff_t>(color) * cells * cells;
    for (int v = 0; v < size; ++v) {
      uint8_t* const row = of_color + static_cast<ptrdiff_t>(v / pool) * cells;
      for (int u = 0; u < size; ++u, ++fields) row[u / pool] = std::min(row[u / pool], *fields);
    }
  }
}

}  // namespace

FieldRows::FieldRows(const uint8_t* fields, int size, int entry_count)
    : pool_(size <= kLargestExact ? 1 : kPool),
      cells_((size + pool_ - 1) / pool_),
      block_count_((static_cast<size_t>(entry_count) + kBlock - 1) / kBlock),
      values_(block_count_ * block_bytes()) {
  const size_t rows = static_cast<size_t>(kColorCount) * cells_ * cells_;
  const size_t entry_bytes = static_cast<size_t>(kColorCount) * size * size;
  tbb::parallel_for(size_t{0}, block_count_, [&](size_t block) {
    std::vector<uint8_t> minima(rows);
    uint8_t* const target = values_.data() + block * block_bytes();
    for (int e = 0; e < kBlock; ++e) {
      const size_t entry = std::min(block * kBlock + e, static_cast<size_t>(entry_count) - 1);
      pool_entry(fields + entry * entry_bytes, size, pool_, cells_, minima.data());
      for (size_t row = 0; row < rows; ++row) target[row * kBlock + e] = minima[row];
    }
  });
  if (!values_.empty()) largest_value_ = *std::max_element(values_.begin(), values_.end());
}

std::vector<WeightedRow> FieldRows::rows_of(const LabelImage& query) const {
  std::vector<uint16_t> counts(static_cast<size_t>(kColorCount) * cells_ * cells_);
  for (int v = 0; v < query.height(); ++v) {
    for (int u = 0; u < query.width(); ++u) {
      const int label = query(u, v);
      if (label != 0) ++counts[((label - 1) * cells_ + v / pool_) * cells_ + u / pool_];
    }
  }
  std::vector<WeightedRow> rows;
  for (size_t row = 0; row < counts.size(); ++row)
    if (counts[row] != 0) rows.push_back({static_cast<uint32_t>(row), counts[row]});
  return rows;
}

}  // namespace glovebench
