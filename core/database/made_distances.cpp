#include "core/database/made_distances.h"

#include <algorithm>
#include <functional>

namespace glovebench {

MadeDistances::MadeDistances(const Database& database, const LabelImage& query)
    : database_(database),
      rows_(database.field_rows(query.width())),
      size_(query.width()),
      cap_(database.field_cap(size_)),
      parts_(kColorCount) {
  std::ranges::copy(query, labels_.labels);
  for (size_t i = 0; i < query.size(); ++i) {
    if (query[i] == 0) continue;
    Part& part = parts_[query[i] - 1];
    const auto chunk = static_cast<uint16_t>(i / QueryLabels::kChunk * QueryLabels::kChunk);
    if (part.chunks.empty() || part.chunks.back().pixels != chunk) part.chunks.push_back({chunk, chunk, query[i]});
    const int v = static_cast<int>(i) / size_;
    if (part.pixels == 0) part.rows_px.first = v;
    part.rows_px.last = v + 1;
    part.color = query[i];
    ++part.pixels;
  }
  for (const WeightedRow& row : rows_.rows_of(query))
    parts_[row.row * kColorCount / rows_.row_count()].bounds.push_back(row);
  std::ranges::stable_sort(parts_, std::greater(), &Part::pixels);
  std::erase_if(parts_, [](const Part& part) { return part.pixels == 0; });
}

uint32_t MadeDistances::sum(int entry, uint32_t limit) const {
  std::array<uint32_t, kColorCount> bounds{};
  uint32_t sum = 0;
  for (size_t p = 0; p < parts_.size(); ++p) sum += bounds[p] = rows_.sum(entry, parts_[p].bounds);
  if (sum > limit || rows_.exact()) return sum;
  const LabelImage labels = database_.labels(size_, entry);
  // As many bytes more as add_chunks may read.
  std::array<uint8_t, QueryLabels::kLargest + QueryLabels::kChunk> field;
  for (size_t p = 0; p < parts_.size() && sum <= limit; ++p) {
    const Part& part = parts_[p];
    chamfer_field(labels, part.color, cap_, std::span(field).first(labels.size()), part.rows_px);
    const uint32_t others = sum - bounds[p];
    sum = others + add_chunks(field.data(), labels_, part.chunks, limit - others, nullptr);
  }
  return sum;
}

}  // namespace glovebench
