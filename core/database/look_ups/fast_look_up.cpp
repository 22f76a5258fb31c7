#include "core/database/look_up_parts.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/database/look_up_kernels.h"
#include "core/database/made_distances.h"

namespace glovebench {
namespace {

/// Adding all rows costs about 1/64 of all distances: 1/40 of those of 1,512 entries, 1/130 of 15,120.
constexpr double kRowSumsCostShare = 1.0 / 64;
constexpr uint32_t kNoLimit = std::numeric_limits<uint32_t>::max();

/// What a query reads in the fields of an entry: its chunks, color by color.
RecycledVector<FieldChunk> chunks_of(const LabelImage& query, const QueryLabels& labels) {
  constexpr size_t kChunk = QueryLabels::kChunk;
  std::array<uint32_t, QueryLabels::kLargest / kChunk> colors{};  // in each chunk: a bit each
  for (size_t i = 0; i < query.size(); ++i) colors[i / kChunk] |= 1u << labels.labels[i];
  RecycledVector<FieldChunk> chunks;
  chunks.reserve(colors.size() * 4);
  for (uint8_t color = 1; color <= kColorCount; ++color) {
    for (size_t pixel = 0; pixel < query.size(); pixel += kChunk) {
      if ((colors[pixel / kChunk] >> color & 1) == 0) continue;
      chunks.push_back(
          {static_cast<uint32_t>((color - 1) * query.size() + pixel), static_cast<uint16_t>(pixel), color});
    }
  }
  return chunks;
}

/// The nearest entries met so far, at most `keep`.
class Nearest {
 public:
  explicit Nearest(size_t keep) : keep_(keep) {}

  /// An entry whose sum is above this is not among the nearest.
  uint32_t limit() const { return heap_.size() < keep_ ? kNoLimit : heap_.front().sum; }
  void add(const Candidate& candidate) {
    if (heap_.size() == keep_) {
      if (!(candidate < heap_.front())) return;
      std::ranges::pop_heap(heap_);
      heap_.pop_back();
    }
    heap_.push_back(candidate);
    std::ranges::push_heap(heap_);
  }
  /// Best first.
  RecycledVector<Candidate> sorted() && {
    std::ranges::sort_heap(heap_);
    return std::move(heap_);
  }

 private:
  size_t keep_;
  RecycledVector<Candidate> heap_;  ///< the farthest first
};

/// Distances of single entries to one query.
class EntryDistances {
 public:
  EntryDistances(const Database& database, const LabelImage& query) : entry_bytes_(kColorCount * query.size()) {
    if (database.memory() == DatabaseMemory::low) {
      made_.emplace(database, query);
      return;
    }
    fields_ = database.fields(query.width(), 0);
    std::ranges::copy(query, labels_.labels);
    chunks_ = chunks_of(query, labels_);
  }

  /// Adds these to the nearest, in their order; `sum` of each is a lower bound of its distance, and they are sorted
  /// by it. Asks for each entry's memory while it works on the one before.
  void add(std::span<const Candidate> candidates, Nearest& nearest) const {
    for (size_t i = 0; i < candidates.size(); ++i) {
      if (candidates[i].sum > nearest.limit()) return;
      const uint8_t* const next = !made_ && i + 1 < candidates.size() ? of(candidates[i + 1]) : nullptr;
      const uint32_t sum = made_ ? made_->sum(candidates[i].entry, nearest.limit())
                                 : add_chunks(of(candidates[i]), labels_, chunks_, nearest.limit(), next);
      nearest.add({sum, candidates[i].entry});
    }
  }

 private:
  const uint8_t* of(const Candidate& candidate) const {
    return fields_ + static_cast<size_t>(candidate.entry) * entry_bytes_;
  }

  const uint8_t* fields_ = nullptr;  ///< of all entries, where they are stored
  size_t entry_bytes_;
  QueryLabels labels_;
  RecycledVector<FieldChunk> chunks_;
  std::optional<MadeDistances> made_;  ///< of a low-memory database
};

/// The sums of a query over the rows of all entries.
struct RowSums {
  RecycledVector<uint16_t> sums;    ///< of whole blocks: also of what lies behind the last entry
  RecycledVector<uint16_t> minima;  ///< of each block
};

RowSums sum_rows(const FieldRows& rows, const LabelImage& query) {
  RowSums result{RecycledVector<uint16_t>(rows.block_count() * FieldRows::kBlock),
                 RecycledVector<uint16_t>(rows.block_count())};
  add_rows(rows, rows.rows_of(query), result.sums, result.minima);
  return result;
}

/// The entries with the least sums, best first, by counting how often each sum occurs.
RecycledVector<Candidate> least_sums(std::span<const uint16_t> sums, size_t keep) {
  const uint16_t largest = *std::ranges::max_element(sums);
  RecycledVector<uint32_t> place(size_t{largest} + 2);  // first counts, then where the next entry of a sum goes
  for (const uint16_t sum : sums) ++place[sum + 1];
  size_t limit = 0;  // sums from here on are not kept
  for (size_t kept = 0; limit <= largest && kept < keep; ++limit) {
    kept += place[limit + 1];
    place[limit + 1] += place[limit];
  }
  RecycledVector<Candidate> candidates(place[limit]);
  for (size_t entry = 0; entry < sums.size(); ++entry)
    if (sums[entry] < limit) candidates[place[sums[entry]]++] = {sums[entry], static_cast<int>(entry)};
  candidates.resize(std::min(keep, candidates.size()));
  return candidates;
}

/// For each of the `count` blocks with the least minima, its best entry.
RecycledVector<Candidate> best_of_blocks(const RowSums& bounds, size_t count) {
  RecycledVector<Candidate> blocks;
  for (size_t b = 0; b < bounds.minima.size(); ++b)
    blocks.push_back({bounds.minima[b], static_cast<int>(b) * FieldRows::kBlock});
  std::ranges::partial_sort(blocks, blocks.begin() + static_cast<ptrdiff_t>(count));
  blocks.resize(count);
  for (Candidate& block : blocks) {
    // Copies of the last entry fill the last block, so the first entry with this sum is a real one.
    while (bounds.sums[block.entry] != block.sum) ++block.entry;
  }
  return blocks;
}

/// The nearest entries by the distances themselves, though only few are computed.
RecycledVector<Candidate> nearest_by_bounds(const FieldRows& rows, const EntryDistances& distances,
                                            const LabelImage& query, size_t keep, int entry_count) {
  const RowSums bounds = sum_rows(rows, query);
  Nearest nearest(keep);
  if (keep > bounds.minima.size() / 4) {  // too many for the blocks' minima to be a start
    distances.add(least_sums(std::span(bounds.sums).first(entry_count), entry_count), nearest);
    return std::move(nearest).sorted();
  }
  const RecycledVector<Candidate> start = best_of_blocks(bounds, keep + 1);
  distances.add(start, nearest);
  RecycledVector<Candidate> others;
  for (size_t b = 0; b < bounds.minima.size(); ++b) {
    if (bounds.minima[b] > nearest.limit()) continue;
    const int first = static_cast<int>(b) * FieldRows::kBlock,
              last = std::min(first + FieldRows::kBlock, entry_count);
    for (int entry = first; entry < last; ++entry) {
      const Candidate candidate{bounds.sums[entry], entry};
      if (candidate.sum <= nearest.limit() && std::ranges::find(start, candidate) == start.end())
        others.push_back(candidate);
    }
  }
  std::ranges::sort(others);
  distances.add(others, nearest);
  return std::move(nearest).sorted();
}

RecycledVector<Candidate> first_stage(const Database& database, const LabelImage& query, size_t keep) {
  const FieldRows& rows = database.field_rows(query.width());
  if (!rows.exact())
    return nearest_by_bounds(rows, EntryDistances(database, query), query, keep, database.entry_count());
  const RowSums sums = sum_rows(rows, query);
  return least_sums(std::span(sums.sums).first(database.entry_count()), keep);
}

RecycledVector<Candidate> later_stage(const Database& database, const LabelImage& query, size_t keep,
                                      RecycledVector<Candidate> candidates) {
  const FieldRows& rows = database.field_rows(query.width());
  if (static_cast<double>(candidates.size()) > kRowSumsCostShare * database.entry_count()) {
    const RowSums bounds = sum_rows(rows, query);
    for (Candidate& candidate : candidates) candidate.sum = bounds.sums[candidate.entry];
    std::ranges::sort(candidates);
  } else {
    for (Candidate& candidate : candidates) candidate.sum = 0;
  }
  Nearest nearest(keep);
  EntryDistances(database, query).add(candidates, nearest);
  return std::move(nearest).sorted();
}

/// A first stage by small images adds up the rows of `FieldRows` over all entries at once; one by large images adds
/// up rows of cell minima, which bounds every distance from below, and computes distances only where the bound is
/// under the last one kept. Later stages stop adding up an entry as soon as it is too far.
RecycledVector<Match> look_up_fast(const Database& database, const TinyImages& query, const Cascade& cascade,
                                   LookUpTrace* trace) {
  RecycledVector<Candidate> candidates;
  size_t glove_pixels = 0;
  for (size_t s = 0; s < cascade.size(); ++s) {
    const LabelImage& image = query.images[s];
    glove_pixels = image.size() - static_cast<size_t>(std::ranges::count(image, uint8_t{0}));
    if (glove_pixels == 0) return {};
    const size_t keep = std::min<size_t>(cascade[s].keep, database.entry_count());
    candidates =
        s == 0 ? first_stage(database, image, keep) : later_stage(database, image, keep, std::move(candidates));
    note_kept(candidates, trace);
  }
  return matches_of(candidates, glove_pixels);
}

}  // namespace

LookUpEntry fast_look_up() {
  return {"fast", "all entries at once, with SIMD and bounds of the distances", look_up_fast};
}

}  // namespace glovebench
