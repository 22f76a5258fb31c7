#include <opencv2/core.hpp>

#include "bench/peers/peers.h"

namespace glovebench::bench {
namespace {

/// cv::Mat::dot of each entry's fields, where they lie, with a query that has 1 where it reads: bytes are a quarter
/// of what cv::gemm would have to read.
class OpenCvLookUp : public LookUpPeer {
 public:
  OpenCvLookUp(const Database& database, int size) : database_(database), size_(size) { cv::setNumThreads(1); }

  RecycledVector<Match> look_up(const LabelImage& query, int keep) override {
    const int pixels = static_cast<int>(query.size());
    cv::Mat vector = cv::Mat::zeros(1, kColorCount * pixels, CV_8U);
    for (const int offset : glove_offsets(query)) vector.data[offset] = 1;
    RecycledVector<Candidate> candidates(database_.entry_count());
    for (int entry = 0; entry < database_.entry_count(); ++entry) {
      // OpenCV has no Mat of constant bytes; it only reads these.
      const cv::Mat fields(1, vector.cols, CV_8U, const_cast<uint8_t*>(database_.fields(size_, entry)));
      candidates[entry] = {static_cast<uint32_t>(fields.dot(vector)), entry};
    }
    work_ = static_cast<double>(vector.cols) * database_.entry_count();
    return nearest(std::move(candidates), keep, cv::countNonZero(vector));
  }

 private:
  const Database& database_;
  int size_;
};

}  // namespace

const MakeLookUpPeer kOpenCv = make_look_up<OpenCvLookUp>;

}  // namespace glovebench::bench
