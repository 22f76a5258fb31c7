#include <algorithm>

#include "bench/peers/peers.h"

// No library: what a user's compiler makes of two short loops. Neither reads a number that the query does not ask
// for.

namespace glovebench::bench {
namespace {

/// Gathers from the fields of one entry after the other, where they lie.
class SparseLookUp : public LookUpPeer {
 public:
  SparseLookUp(const Database& database, int size) : database_(database), size_(size) {}

  RecycledVector<Match> look_up(const LabelImage& query, int keep) override {
    RecycledVector<int> offsets = glove_offsets(query);
    std::ranges::sort(offsets);  // upward through memory
    RecycledVector<Candidate> candidates(database_.entry_count());
    for (int entry = 0; entry < database_.entry_count(); ++entry) {
      const uint8_t* const fields = database_.fields(size_, entry);
      uint32_t sum = 0;
      for (const int offset : offsets) sum += fields[offset];
      candidates[entry] = {sum, entry};
    }
    work_ = static_cast<double>(offsets.size()) * database_.entry_count();
    return nearest(std::move(candidates), keep, offsets.size());
  }

 private:
  const Database& database_;
  int size_;
};

/// Adds up rows of a copy that has one for each color and pixel, a block of entries after the other.
class SparseRowsLookUp : public LookUpPeer {
 public:
  SparseRowsLookUp(const Database& database, int size)
      : entry_count_(database.entry_count()), row_count_(static_cast<size_t>(kColorCount) * size * size) {
    const int blocks = (entry_count_ + kBlock - 1) / kBlock;
    values_.resize(blocks * row_count_ * kBlock);
    constexpr size_t kTile = 64;  // rows: a cache line of an entry's fields
    for (size_t first = 0; first < row_count_; first += kTile) {
      for (int entry = 0; entry < entry_count_; ++entry) {
        const uint8_t* const fields = database.fields(size, entry);
        for (size_t row = first; row < std::min(first + kTile, row_count_); ++row)
          values_[(entry / kBlock * row_count_ + row) * kBlock + entry % kBlock] = fields[row];
      }
    }
  }

  RecycledVector<Match> look_up(const LabelImage& query, int keep) override {
    const RecycledVector<int> offsets = glove_offsets(query);
    RecycledVector<Candidate> candidates(entry_count_);
    for (int first = 0; first < entry_count_; first += kBlock) {
      const Sums sums = sum_block(values_.data() + first * row_count_, offsets);
      for (int entry = first; entry < std::min(first + kBlock, entry_count_); ++entry)
        candidates[entry] = {sums[entry - first], entry};
    }
    work_ = static_cast<double>(offsets.size()) * entry_count_;
    return nearest(std::move(candidates), keep, offsets.size());
  }

 private:
  static constexpr int kBlock = 1024;  // sums that stay in the first cache
  using Sums = std::array<uint32_t, kBlock>;

  static Sums sum_block(const uint8_t* block, std::span<const int> offsets) {
    constexpr size_t kShort = 256;  // rows whose sum fits 16 bits
    Sums sums{};
    for (size_t first = 0; first < offsets.size(); first += kShort) {
      std::array<uint16_t, kBlock> part{};
      for (const int offset : offsets.subspan(first, std::min(kShort, offsets.size() - first))) {
        const uint8_t* const row = block + static_cast<size_t>(offset) * kBlock;
        for (int i = 0; i < kBlock; ++i) part[i] = static_cast<uint16_t>(part[i] + row[i]);
      }
      for (int i = 0; i < kBlock; ++i) sums[i] += part[i];
    }
    return sums;
  }

  int entry_count_;
  size_t row_count_;
  std::vector<uint8_t> values_;  ///< [block][color and pixel][entry]
};

}  // namespace

const MakeLookUpPeer kSparse = make_look_up<SparseLookUp>, kSparseRows = make_look_up<SparseRowsLookUp>;

}  // namespace glovebench::bench
