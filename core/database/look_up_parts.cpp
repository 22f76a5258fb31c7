#include "core/database/look_up_parts.h"

#include <algorithm>
#include <span>

#include "core/database/distance_field.h"

namespace glovebench {

RecycledVector<int> glove_offsets(const LabelImage& query) {
  RecycledVector<int> offsets;
  const int pixels = static_cast<int>(query.size());
  for (int i = 0; i < pixels; ++i)
    if (query[i] != 0) offsets.push_back((query[i] - 1) * pixels + i);
  return offsets;
}

uint32_t sum_of(const uint8_t* fields, const RecycledVector<int>& offsets) {
  uint32_t sum = 0;
  for (const int offset : offsets) sum += fields[offset];
  return sum;
}

EntryFields::EntryFields(const Database& database, const LabelImage& query)
    : database_(database), size_(query.width()) {
  for (uint8_t color = 1; color <= kColorCount; ++color)
    if (std::ranges::find(query, color) != query.end()) colors_.push_back(color);
  if (database.memory() == DatabaseMemory::low) made_.resize(kColorCount * query.size());
}

const uint8_t* EntryFields::of(int entry) {
  if (made_.empty()) return database_.fields(size_, entry);
  const LabelImage labels = database_.labels(size_, entry);
  const uint8_t cap = database_.field_cap(size_);
  for (const uint8_t color : colors_)
    chamfer_field(labels, color, cap, std::span(made_).subspan((color - 1) * labels.size(), labels.size()));
  return made_.data();
}

}  // namespace glovebench
