#include <algorithm>
#include <opencv2/core.hpp>

#include "bench/peers/peers.h"
#include "core/database/look_up_parts.h"

namespace glovebench::bench {
namespace {

/// cv::Mat::dot of each entry's fields, where they lie, with a query that has 1 where it reads: bytes are a quarter
/// of what cv::gemm would have to read.
class OpenCvLookUp : public LookUpPeer {
 public:
  OpenCvLookUp(const Database& database, int size) : database_(database), size_(size) { cv::setNumThreads(1); }

  std::vector<RecycledVector<Match>> operator()(std::span<const LabelImage> queries, int keep) override {
    std::vector<RecycledVector<Match>> matches;
    for (const LabelImage& query : queries) matches.push_back(look_up(query, keep));
    return matches;
  }

 private:
  RecycledVector<Match> look_up(const LabelImage& query, int keep) {
    const int pixels = static_cast<int>(query.size());
    cv::Mat vector = cv::Mat::zeros(1, kColorCount * pixels, CV_8U);
    for (int i = 0; i < pixels; ++i)
      if (query[i] != 0) vector.data[(query[i] - 1) * pixels + i] = 1;
    RecycledVector<Candidate> candidates(database_.entry_count());
    for (int entry = 0; entry < database_.entry_count(); ++entry) {
      // OpenCV has no Mat of constant bytes; it only reads these.
      const cv::Mat fields(1, vector.cols, CV_8U, const_cast<uint8_t*>(database_.fields(size_, entry)));
      candidates[entry] = {static_cast<uint32_t>(fields.dot(vector)), entry};
    }
    std::partial_sort(candidates.begin(), candidates.begin() + keep, candidates.end());
    candidates.resize(keep);
    return matches_of(candidates, cv::countNonZero(vector));
  }

  const Database& database_;
  int size_;
};

std::unique_ptr<LookUpPeer> make(const Database& database, int size) {
  return std::make_unique<OpenCvLookUp>(database, size);
}

}  // namespace

const MakeLookUpPeer kOpenCv = make;

}  // namespace glovebench::bench
