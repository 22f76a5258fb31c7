#include <faiss/IndexFlat.h>
#include <faiss/IndexHNSW.h>
#include <faiss/IndexPQ.h>
#include <faiss/IndexScalarQuantizer.h>
#include <faiss/utils/distances.h>
#include <omp.h>

#include <algorithm>
#include <vector>

#include "bench/peers/peers.h"

namespace glovebench::bench {
namespace {

/// The largest inner product is the least sum of equation (2): an entry's vector has kNear minus each of its
/// fields, a query's has 1 where it reads. Products stay below 2^24, so that single precision is exact.
constexpr uint8_t kNear = 255;

class FaissLookUp : public LookUpPeer {
 public:
  FaissLookUp(const Database& database, int size, std::unique_ptr<faiss::Index> index) : index_(std::move(index)) {
    omp_set_num_threads(1);
    faiss::distance_compute_blas_threshold = 1;   // one query, too, is faster with it
    constexpr int kTrained = 2048, kAdded = 512;  // entries, at most
    if (!index_->is_trained) {
      const int step = std::max(1, database.entry_count() / kTrained);
      const std::vector<float> values = vectors_of(database, size, 0, database.entry_count(), step);
      index_->train(static_cast<int64_t>(values.size()) / index_->d, values.data());
    }
    for (int first = 0; first < database.entry_count(); first += kAdded) {
      const int last = std::min(first + kAdded, database.entry_count());
      index_->add(last - first, vectors_of(database, size, first, last, 1).data());
    }
    // A graph by products would link all entries to the few with the longest vectors: it is one by distances,
    // searched for the largest product.
    if (auto* const graph = dynamic_cast<faiss::IndexHNSW*>(index_.get()))
      graph->metric_type = graph->storage->metric_type = faiss::METRIC_INNER_PRODUCT;
  }

  RecycledVector<Match> look_up(const LabelImage& query, int keep) override {
    return std::move(look_up_all({&query, 1}, keep)[0]);
  }

  std::vector<RecycledVector<Match>> look_up_all(std::span<const LabelImage> queries, int keep) override {
    vectors_.assign(queries.size() * index_->d, 0.0f);
    for (size_t q = 0; q < queries.size(); ++q)
      for (const int offset : glove_offsets(queries[q])) vectors_[q * index_->d + offset] = 1;
    products_.resize(queries.size() * keep);
    entries_.resize(queries.size() * keep);
    faiss::hnsw_stats.reset();
    index_->search(static_cast<int64_t>(queries.size()), vectors_.data(), keep, products_.data(), entries_.data());
    work_ = work_of_one(static_cast<double>(faiss::hnsw_stats.ndis) / static_cast<double>(queries.size()));
    std::vector<RecycledVector<Match>> matches(queries.size());
    for (size_t q = 0; q < queries.size(); ++q) {
      const size_t glove_pixels = glove_offsets(queries[q]).size();
      for (size_t i = q * keep; i < (q + 1) * keep; ++i) {
        const float sum = static_cast<float>(kNear * glove_pixels) - products_[i];
        matches[q].push_back({static_cast<int>(entries_[i]),
                              pixels_from_sum(static_cast<uint32_t>(std::max(0.0f, sum)), glove_pixels)});
      }
    }
    return matches;
  }

 private:
  std::vector<float> vectors_of(const Database& database, int size, int first, int last, int step) const {
    std::vector<float> values;
    for (int entry = first; entry < last; entry += step) {
      const uint8_t* const fields = database.fields(size, entry);
      for (int i = 0; i < index_->d; ++i) values.push_back(static_cast<float>(kNear - fields[i]));
    }
    return values;
  }

  /// `visited`: vectors that a search in a graph compared.
  double work_of_one(double visited) const {
    const auto d = static_cast<double>(index_->d), entries = static_cast<double>(index_->ntotal);
    if (dynamic_cast<const faiss::IndexHNSW*>(index_.get()) != nullptr) return visited * d;
    if (const auto* const pq = dynamic_cast<const faiss::IndexPQ*>(index_.get()))
      return static_cast<double>(pq->pq.ksub) * d + static_cast<double>(pq->pq.M) * entries;
    return d * entries;
  }

  std::unique_ptr<faiss::Index> index_;
  std::vector<float> vectors_, products_;
  std::vector<int64_t> entries_;
};

constexpr faiss::MetricType kProduct = faiss::METRIC_INNER_PRODUCT;

std::unique_ptr<faiss::Index> flat(int d) { return std::make_unique<faiss::IndexFlatIP>(d); }

/// Bytes as they are, of the query, too: exact.
std::unique_ptr<faiss::Index> bytes(int d) {
  return std::make_unique<faiss::IndexScalarQuantizer>(d, faiss::ScalarQuantizer::QT_8bit_direct, kProduct);
}

/// Each dimension's range in 255 steps.
std::unique_ptr<faiss::Index> steps(int d) {
  return std::make_unique<faiss::IndexScalarQuantizer>(d, faiss::ScalarQuantizer::QT_8bit, kProduct);
}

std::unique_ptr<faiss::Index> pq(int d) {
  constexpr int kParts = 160, kBits = 8;  // 160 bytes an entry; divides the dimensions of all sizes
  auto index = std::make_unique<faiss::IndexPQ>(d, kParts, kBits, kProduct);
  index->pq.cp.niter = 10;
  index->pq.cp.min_points_per_centroid = 1;  // no warning
  return index;
}

std::unique_ptr<faiss::Index> graph(int d) {
  constexpr int kNeighbors = 32;
  auto index = std::make_unique<faiss::IndexHNSWFlat>(d, kNeighbors, faiss::METRIC_L2);
  index->hnsw.efSearch = 128;
  return index;
}

template <std::unique_ptr<faiss::Index> (*make_index)(int d)>
std::unique_ptr<LookUpPeer> make(const Database& database, int size) {
  return std::make_unique<FaissLookUp>(database, size, make_index(kColorCount * size * size));
}

}  // namespace

const MakeLookUpPeer kFaiss = make<flat>, kFaissBytes = make<bytes>, kFaiss8Bit = make<steps>, kFaissPq = make<pq>,
                     kFaissHnsw = make<graph>;

}  // namespace glovebench::bench
