#include "core/database/field_rows.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace glovebench {
namespace {

constexpr int kPool = FieldRows::kPool;
constexpr int kWidest = 64;  // px

/// The least of each kPool neighbors along a row, every one a cell.
void pool_row(const std::array<uint8_t, kWidest + kPool>& row, int cells, uint8_t* minima) {
  static_assert(kPool == 4, "two halvings");
  std::array<uint8_t, kWidest + kPool> pairs{}, fours{};
  for (int u = 0; u < kWidest + 2; ++u) pairs[u] = std::min(row[u], row[u + 1]);
  for (int u = 0; u < kWidest; ++u) fours[u] = std::min(pairs[u], pairs[u + 2]);
  for (int cell = 0; cell < cells; ++cell) minima[cell] = fours[cell * kPool];
}

/// The least value of each cell of one entry: kColorCount fields of cells * cells.
void pool_entry(const uint8_t* fields, int size, int cells, uint8_t* minima) {
  for (int color = 0; color < kColorCount; ++color) {
    for (int top = 0; top < size; top += kPool, minima += cells) {
      std::array<uint8_t, kWidest + kPool> row;
      row.fill(255);
      for (int v = top; v < std::min(size, top + kPool); ++v, fields += size)
        for (int u = 0; u < size; ++u) row[u] = std::min(row[u], fields[u]);
      pool_row(row, cells, minima);
    }
  }
}

}  // namespace

FieldRows::FieldRows(int size, int entry_count, std::span<const uint8_t> values)
    : pool_(size <= kLargestExact ? 1 : kPool),
      cells_((size + pool_ - 1) / pool_),
      block_count_((static_cast<size_t>(entry_count) + kBlock - 1) / kBlock),
      largest_value_(values.empty() ? uint8_t{0} : *std::ranges::max_element(values)),
      values_(values) {
  for (int u = 0; u < size; ++u) cell_of_pixel_[u] = static_cast<uint8_t>(u / pool_);
}

size_t FieldRows::bytes(int size, int entry_count) {
  const FieldRows rows(size, entry_count, {});
  return rows.block_count() * rows.block_bytes();
}

void FieldRows::arrange(const uint8_t* fields, int size, int entry_count, std::span<uint8_t> values) {
  const FieldRows shape(size, entry_count, {});
  const size_t rows = shape.block_bytes() / kBlock;
  const size_t entry_bytes = static_cast<size_t>(kColorCount) * size * size;
  tbb::parallel_for(size_t{0}, shape.block_count(), [&](size_t block) {
    std::vector<uint8_t> pooled(rows);
    uint8_t* const target = values.data() + block * shape.block_bytes();
    for (int e = 0; e < kBlock; ++e) {
      const size_t entry = std::min(block * kBlock + e, static_cast<size_t>(entry_count) - 1);
      const uint8_t* values_of_entry = fields + entry * entry_bytes;
      if (!shape.exact()) {
        pool_entry(values_of_entry, size, shape.cells_, pooled.data());
        values_of_entry = pooled.data();
      }
      for (size_t row = 0; row < rows; ++row) target[row * kBlock + e] = values_of_entry[row];
    }
  });
}

std::vector<WeightedRow> FieldRows::rows_of(const LabelImage& query) const {
  std::vector<uint16_t> counts(static_cast<size_t>(kColorCount) * cells_ * cells_);
  for (int v = 0; v < query.height(); ++v) {
    const uint8_t* const labels = query.data() + static_cast<ptrdiff_t>(v) * query.width();
    uint16_t* const row_of_cells = counts.data() + static_cast<ptrdiff_t>(v / pool_) * cells_;
    for (int u = 0; u < query.width(); ++u) {
      if (labels[u] != 0) ++row_of_cells[(labels[u] - 1) * cells_ * cells_ + cell_of_pixel_[u]];
    }
  }
  std::vector<WeightedRow> rows;
  rows.reserve(counts.size() / 4);
  for (size_t row = 0; row < counts.size(); ++row)
    if (counts[row] != 0) rows.push_back({static_cast<uint32_t>(row), counts[row]});
  return rows;
}

}  // namespace glovebench
