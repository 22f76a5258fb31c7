// What the stored distance fields change: small integers of the chamfer 3-4 metric, against exact Euclidean
// distances in floating point, with the same cap. Over all entries, for the frames of the five trajectories.

#include <oneapi/tbb/parallel_for.h>

#include <opencv2/imgproc.hpp>

#include "bench/bench_data.h"
#include "core/base/math.h"
#include "core/database/look_up.h"
#include "core/pose/interpolate.h"

namespace glovebench::bench {
namespace {

constexpr int kSize = 64;  // px
constexpr size_t kKept = 3;

/// Equation (2) for each query, over the Euclidean fields of one entry, px.
std::vector<float> euclidean_distances(int entry, const std::vector<LabelImage>& queries) {
  const Database& database = *data().database;
  const float cap = static_cast<float>(data().config.views.field_cap_share * kSize);
  LabelImage image = database.labels(kSize, entry);
  const cv::Mat labels(kSize, kSize, CV_8U, image.data());
  std::vector<double> sums(queries.size());
  for (int color = 1; color <= kColorCount; ++color) {
    cv::Mat field(kSize, kSize, CV_32F, cv::Scalar(cap));
    if (cv::countNonZero(labels == color) > 0) {
      cv::distanceTransform(labels != color, field, cv::DIST_L2, cv::DIST_MASK_PRECISE);
      cv::min(field, cap, field);
    }
    for (size_t q = 0; q < queries.size(); ++q)
      for (size_t i = 0; i < queries[q].size(); ++i)
        if (queries[q][i] == color) sums[q] += field.ptr<float>()[i];
  }
  std::vector<float> distances;
  for (size_t q = 0; q < queries.size(); ++q) {
    const auto pixels = static_cast<double>(queries[q].size() - std::ranges::count(queries[q], 0));
    distances.push_back(static_cast<float>(sums[q] / pixels));
  }
  return distances;
}

RecycledVector<Match> nearest(const std::vector<float>& distances) {
  RecycledVector<Match> matches;
  for (size_t entry = 0; entry < distances.size(); ++entry)
    matches.push_back({static_cast<int>(entry), distances[entry]});
  std::ranges::partial_sort(matches, matches.begin() + kKept, [](const Match& a, const Match& b) {
    return a.error != b.error ? a.error < b.error : a.entry < b.entry;
  });
  matches.resize(kKept);
  return matches;
}

/// Mean over the angles of the squared error of the posture that the matches make, rad^2.
double squared_posture_error(const RecycledVector<Match>& matches, const BenchFrame& frame) {
  const CoarseEstimate estimate =
      interpolate(*data().database, matches, square_ray(frame.square, data().calibration.ir),
                  data().config.lookup.interpolation_epsilon);
  return (estimate.posture - frame.hand.posture).squaredNorm() / static_cast<double>(estimate.posture.size());
}

void field_audit(benchmark::State& state) {
  const std::vector<BenchFrame>& frames = data().frames;
  const Cascade exact = parse_cascade("exact:3");
  std::vector<LabelImage> queries;
  for (const BenchFrame& frame : frames)
    queries.push_back(make_tiny_images(frame.trace.cloud.labels, frame.square, exact).images.front());
  std::vector<std::vector<float>> distances(frames.size(), std::vector<float>(data().database->entry_count()));
  for (auto _ : state) {
    tbb::parallel_for(0, data().database->entry_count(), [&](int entry) {
      const std::vector<float> of_entry = euclidean_distances(entry, queries);
      for (size_t q = 0; q < queries.size(); ++q) distances[q][entry] = of_entry[q];
    });
  }
  double same_first = 0, same_three = 0, rank = 0, stored_error = 0, euclidean_error = 0;
  for (size_t q = 0; q < frames.size(); ++q) {
    const RecycledVector<Match> stored = look_up(*data().database, {{queries[q]}}, exact);
    const RecycledVector<Match> euclidean = nearest(distances[q]);
    const auto entry = [](const Match& match) { return match.entry; };
    same_first += stored.front().entry == euclidean.front().entry;
    same_three += std::ranges::is_permutation(stored, euclidean, {}, entry, entry);
    const float of_stored = distances[q][stored.front().entry];
    rank += 1 + static_cast<double>(std::ranges::count_if(distances[q], [&](float d) { return d < of_stored; }));
    stored_error += squared_posture_error(stored, frames[q]);
    euclidean_error += squared_posture_error(euclidean, frames[q]);
  }
  const auto count = static_cast<double>(frames.size());
  state.counters["same_first"] = same_first / count;
  state.counters["same_three"] = same_three / count;
  state.counters["rank"] = rank / count;
  state.counters["posture_deg"] = degrees_from_radians(std::sqrt(stored_error / count));
  state.counters["posture_deg_euclidean"] = degrees_from_radians(std::sqrt(euclidean_error / count));
}
BENCHMARK(field_audit)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace glovebench::bench
