#include "core/database/field_rows.h"

#include <algorithm>

namespace glovebench {
namespace {

constexpr int kLargestPool = 8, kWidest = 64;  // px

int pool_of(int size, DatabaseMemory memory) {
  if (size <= FieldRows::kLargestExact) return 1;
  return memory == DatabaseMemory::low && size > FieldRows::kLargestFinePool ? kLargestPool : kLargestPool / 2;
}

constexpr int kRow = kWidest + kLargestPool;  // bytes

// The index checks of std::array and the references of std::min prevent vectorization.

uint8_t lesser(uint8_t a, uint8_t b) { return a < b ? a : b; }

/// The least of each `pool` neighbors along a row of kRow bytes, every one a cell.
void pool_row(uint8_t* row, int pool, int cells, uint8_t* minima) {
  for (int step = 1; step < pool; step *= 2) {
    uint8_t before[kRow];
    std::copy_n(row, kRow, before);
    for (int u = 0; u < kWidest; ++u) row[u] = lesser(before[u], before[u + step]);
  }
  for (int cell = 0; cell < cells; ++cell) minima[cell] = row[cell * pool];
}

/// The least value of each cell of one entry: kColorCount fields of cells * cells.
void pool_entry(const uint8_t* fields, int size, int pool, int cells, uint8_t* minima) {
  for (int color = 0; color < kColorCount; ++color) {
    for (int top = 0; top < size; top += pool, minima += cells) {
      uint8_t row[kRow];
      std::ranges::fill(row, uint8_t{255});
      for (int v = top; v < std::min(size, top + pool); ++v, fields += size)
        for (int u = 0; u < size; ++u) row[u] = lesser(row[u], fields[u]);
      pool_row(row, pool, cells, minima);
    }
  }
}

}  // namespace

FieldRows::FieldRows(int size, DatabaseMemory memory, int entry_count, uint8_t largest_value)
    : size_(size),
      entry_count_(entry_count),
      pool_(pool_of(size, memory)),
      cells_((size + pool_ - 1) / pool_),
      block_count_((static_cast<size_t>(entry_count) + kBlock - 1) / kBlock),
      largest_value_(largest_value),
      values_(MappedMemory::zeros(block_count_ * block_bytes())) {
  for (int u = 0; u < size; ++u) cell_of_pixel_[u] = static_cast<uint8_t>(u / pool_);
}

void FieldRows::put(int first, std::span<const uint8_t> fields) {
  const size_t entry_bytes = static_cast<size_t>(kColorCount) * size_ * size_, count = fields.size() / entry_bytes;
  std::vector<uint8_t> pooled(exact() ? 0 : count * row_count());
  for (size_t i = 0; i * row_count() < pooled.size(); ++i)
    pool_entry(&fields[i * entry_bytes], size_, pool_, cells_, &pooled[i * row_count()]);
  const uint8_t* const values = exact() ? fields.data() : pooled.data();
  const size_t rows = row_count();
  const auto place_of = [&](int entry) {
    return values_.writable().data() + entry / kBlock * block_bytes() + entry % kBlock;
  };
  // A few rows of all entries at a time stay in the first cache.
  for (size_t begin = 0; begin < rows; begin += kBlock) {
    const size_t end = std::min(begin + kBlock, rows);
    for (size_t i = 0; i < count; ++i) {
      const uint8_t* const from = values + i * rows;
      uint8_t* const place = place_of(first + static_cast<int>(i));
      for (size_t row = begin; row < end; ++row) place[row * kBlock] = from[row];
    }
  }
  const int last = entry_count_ - 1;
  if (first + static_cast<int>(count) <= last) return;
  uint8_t* const place = place_of(last);
  for (size_t row = 0; row < rows; ++row)
    std::fill_n(place + row * kBlock, kBlock - last % kBlock, place[row * kBlock]);
}

uint32_t FieldRows::sum(int entry, std::span<const WeightedRow> rows) const {
  const uint8_t* const values = data() + entry / kBlock * block_bytes() + entry % kBlock;
  uint32_t sum = 0;
  for (const WeightedRow& weighted : rows) sum += weighted.weight * values[size_t{weighted.row} * kBlock];
  return sum;
}

RecycledVector<WeightedRow> FieldRows::rows_of(const LabelImage& query) const {
  RecycledVector<uint16_t> counts(static_cast<size_t>(kColorCount) * cells_ * cells_);
  for (int v = 0; v < query.height(); ++v) {
    const uint8_t* const labels = query.data() + static_cast<ptrdiff_t>(v) * query.width();
    uint16_t* const row_of_cells = counts.data() + static_cast<ptrdiff_t>(v / pool_) * cells_;
    for (int u = 0; u < query.width(); ++u)
      if (labels[u] != 0) ++row_of_cells[(labels[u] - 1) * cells_ * cells_ + cell_of_pixel_[u]];
  }
  RecycledVector<WeightedRow> rows;
  rows.reserve(counts.size() / 4);
  for (size_t row = 0; row < counts.size(); ++row)
    if (counts[row] != 0) rows.push_back({static_cast<uint32_t>(row), counts[row]});
  return rows;
}

}  // namespace glovebench
