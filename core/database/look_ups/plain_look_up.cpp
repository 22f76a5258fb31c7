#include <algorithm>

#include "core/database/look_up_parts.h"

namespace glovebench {
namespace {

RecycledVector<Match> look_up_plain(const Database& database, const TinyImages& query, const Cascade& cascade,
                                    LookUpTrace* trace) {
  RecycledVector<Candidate> candidates(database.entry_count());
  for (int entry = 0; entry < database.entry_count(); ++entry) candidates[entry] = {0, entry};
  size_t glove_pixels = 0;
  for (size_t s = 0; s < cascade.size(); ++s) {
    const RecycledVector<int> offsets = glove_offsets(query.images[s]);
    if (offsets.empty()) return {};
    EntryFields fields(database, query.images[s]);
    for (Candidate& candidate : candidates) candidate.sum = sum_of(fields.of(candidate.entry), offsets);
    const size_t keep = std::min<size_t>(cascade[s].keep, candidates.size());
    std::partial_sort(candidates.begin(), candidates.begin() + static_cast<ptrdiff_t>(keep), candidates.end());
    candidates.resize(keep);
    note_kept(candidates, trace);
    glove_pixels = offsets.size();
  }
  return matches_of(candidates, glove_pixels);
}

}  // namespace

LookUpEntry plain_look_up() {
  return {"plain", "entry after entry, as the paper describes it (section III-B)", look_up_plain};
}

}  // namespace glovebench
