#include "core/database/look_up.h"

#include <algorithm>

#include "core/base/registry.h"
#include "core/database/look_up_parts.h"

namespace glovebench {

RecycledVector<int> glove_offsets(const LabelImage& query) {
  RecycledVector<int> offsets;
  const int pixels = static_cast<int>(query.size());
  for (int i = 0; i < pixels; ++i) {
    if (query[i] != 0) offsets.push_back((query[i] - 1) * pixels + i);
  }
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

TinyImages make_tiny_images(const LabelImage& labels, const Square& square, const Cascade& cascade) {
  TinyImages query;
  for (const CascadeStage& stage : cascade) {
    query.images.push_back(make_tiny_image(labels, square, stage.size));
  }
  return query;
}

float distance(const Database& database, int entry, const LabelImage& query) {
  const RecycledVector<int> offsets = glove_offsets(query);
  if (offsets.empty()) return 0;
  return pixels_from_sum(sum_of(EntryFields(database, query).of(entry), offsets), offsets.size());
}

std::vector<float> distances(const Database& database, const LabelImage& query) {
  const RecycledVector<int> offsets = glove_offsets(query);
  std::vector<float> result(database.entry_count(), 0.0f);
  if (offsets.empty()) return result;
  EntryFields fields(database, query);
  for (int entry = 0; entry < database.entry_count(); ++entry)
    result[entry] = pixels_from_sum(sum_of(fields.of(entry), offsets), offsets.size());
  return result;
}

RecycledVector<Match> look_up(const Database& database, const TinyImages& query, const Cascade& cascade,
                              std::string_view name, LookUpTrace* trace) {
  const LookUpEntry& entry = find_in(look_ups(), name, "look-up", "name");
  database.require_unchanged();
  if (trace != nullptr) trace->kept.clear();
  return entry.look_up(database, query, cascade, trace);
}

}  // namespace glovebench
