#pragma once

#include <vector>

#include "core/database/database.h"
#include "core/database/look_up.h"

namespace glovebench {

/// A database entry in a stage of the look-up.
struct Candidate {
  uint32_t sum = 0;  ///< of the stored distances over the query's glove pixels, 1/kFieldScale px; <= 4096 * 255
  int entry = 0;

  friend auto operator<=>(const Candidate&, const Candidate&) = default;
};

/// The mean distance, px.
inline float pixels_from_sum(uint32_t sum, size_t glove_pixels) {
  return static_cast<float>(sum) / static_cast<float>(kFieldScale * glove_pixels);
}

/// Where a query reads in the fields of an entry: one offset a glove pixel.
RecycledVector<int> glove_offsets(const LabelImage& query);
/// Sum of the distances, in steps of 1/kFieldScale px; at most 4096 * 255.
uint32_t sum_of(const uint8_t* fields, const RecycledVector<int>& offsets);

/// Appends what a stage kept to the trace, if there is one.
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

/// The fields of single entries for one query: as they are stored, or made of the labels in a low-memory database.
/// The values are the same.
class EntryFields {
 public:
  /// `query` has the size whose fields are wanted. Throws Error if that size was not loaded.
  EntryFields(const Database& database, const LabelImage& query);
  /// As `Database::fields`, but with any values for colors that the query does not have. Valid up to the next call.
  const uint8_t* of(int entry);

 private:
  const Database& database_;
  int size_;
  std::vector<uint8_t> colors_;  ///< the query's
  std::vector<uint8_t> made_;    ///< of one entry; none: fields are stored
};

}  // namespace glovebench
