#include <faiss/IndexFlat.h>
#include <faiss/utils/distances.h>
#include <omp.h>

#include <algorithm>
#include <vector>

#include "bench/peers/peers.h"
#include "core/database/look_up_parts.h"

namespace glovebench::bench {
namespace {

/// An entry's fields as one vector; a query has -1 where it reads: the inner product is minus the sum of equation
/// (2). Sums stay below 2^24, so that single precision is exact.
class FaissLookUp : public LookUpPeer {
 public:
  FaissLookUp(const Database& database, int size) : index_(static_cast<int64_t>(kColorCount) * size * size) {
    omp_set_num_threads(1);
    faiss::distance_compute_blas_threshold = 1;  // one query, too, is faster with it
    std::vector<float> values(index_.d);
    index_.codes.reserve(static_cast<size_t>(database.entry_count()) * index_.d * sizeof(float));
    for (int entry = 0; entry < database.entry_count(); ++entry) {
      std::copy_n(database.fields(size, entry), values.size(), values.begin());
      index_.add(1, values.data());
    }
  }

  std::vector<RecycledVector<Match>> operator()(std::span<const LabelImage> queries, int keep) override {
    vectors_.assign(queries.size() * index_.d, 0.0f);
    for (size_t q = 0; q < queries.size(); ++q) {
      const LabelImage& query = queries[q];
      for (size_t i = 0; i < query.size(); ++i)
        if (query[i] != 0) vectors_[q * index_.d + (query[i] - 1) * query.size() + i] = -1;
    }
    products_.resize(queries.size() * keep);
    entries_.resize(queries.size() * keep);
    index_.search(static_cast<int64_t>(queries.size()), vectors_.data(), keep, products_.data(), entries_.data());
    std::vector<RecycledVector<Match>> matches(queries.size());
    for (size_t q = 0; q < queries.size(); ++q) {
      const size_t glove_pixels = queries[q].size() - std::ranges::count(queries[q], uint8_t{0});
      for (size_t i = q * keep; i < (q + 1) * keep; ++i) {
        matches[q].push_back(
            {static_cast<int>(entries_[i]), pixels_from_sum(static_cast<uint32_t>(-products_[i]), glove_pixels)});
      }
    }
    return matches;
  }

 private:
  faiss::IndexFlatIP index_;
  std::vector<float> vectors_, products_;
  std::vector<int64_t> entries_;
};

std::unique_ptr<LookUpPeer> make(const Database& database, int size) {
  return std::make_unique<FaissLookUp>(database, size);
}

}  // namespace

const MakeLookUpPeer kFaiss = make;

}  // namespace glovebench::bench
