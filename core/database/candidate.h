#pragma once

#include <vector>

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

}  // namespace glovebench
