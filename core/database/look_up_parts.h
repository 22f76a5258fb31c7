#pragma once

#include <vector>

#include "core/database/database.h"
#include "core/database/look_up.h"

namespace glovebench {

struct Candidate {
  uint32_t sum = 0;  ///< of distances, 1/kFieldScale px
  int entry = 0;

  friend auto operator<=>(const Candidate&, const Candidate&) = default;
};

/// Mean, px.
inline float pixels_from_sum(uint32_t sum, size_t glove_pixels) {
  return static_cast<float>(sum) / static_cast<float>(kFieldScale * glove_pixels);
}

/// Offsets into an entry's fields, one per glove pixel of the query.
RecycledVector<int> glove_offsets(const LabelImage& query);
/// In 1/kFieldScale px, at most 4096 * 255.
uint32_t sum_of(const uint8_t* fields, const RecycledVector<int>& offsets);

inline void note_kept(const RecycledVector<Candidate>& candidates, LookUpTrace* trace) {
  if (trace == nullptr) return;
  std::vector<int>& kept = trace->kept.emplace_back();
  for (const Candidate& candidate : candidates) kept.push_back(candidate.entry);
}

inline RecycledVector<Match> matches_of(const RecycledVector<Candidate>& candidates, size_t glove_pixels) {
  RecycledVector<Match> matches;
  for (const Candidate& candidate : candidates)
    matches.push_back({candidate.entry, pixels_from_sum(candidate.sum, glove_pixels)});
  return matches;
}

/// Stored fields, or made from labels.
class EntryFields {
 public:
  /// Throws: Error if the query's size is not loaded.
  EntryFields(const Database& database, const LabelImage& query);
  /// As Database::fields, undefined for colors that the query lacks. Valid until the next call.
  const uint8_t* of(int entry);

 private:
  const Database& database_;
  int size_;
  std::vector<uint8_t> colors_;
  std::vector<uint8_t> made_;
};

}  // namespace glovebench
