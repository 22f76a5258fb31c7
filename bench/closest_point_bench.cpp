#include "bench/bench_data.h"
#include "core/pose/closest_point.h"
#include "core/pose/closest_point_search.h"
#include "core/pose/icp.h"

namespace glovebench::bench {
namespace {

/// One frame's points in the hand frame as an alignment sees them: at the coarse pose, then nearer the final one.
struct PointSequence {
  Surface surface;
  std::vector<std::vector<LabeledPoint>> points_hand;
};

constexpr int kIterations = 10;

PointSequence make_sequence(const BenchFrame& frame, int max_points) {
  const Eigen::Isometry3d& coarse = frame.result.T_camera_hand_coarse;
  const Eigen::Isometry3d& fine = frame.result.T_camera_hand_unfiltered;
  const Eigen::Quaterniond q_coarse(coarse.linear()), q_fine(fine.linear());
  PointSequence sequence{Surface(*data().model, frame.posed, coarse.inverse().translation().cast<float>()), {}};
  const std::vector<LabeledPoint> cloud = subsample(frame.trace.cloud.points, max_points);
  for (int i = 0; i < kIterations; ++i) {
    const double share = 1 - std::pow(0.5, i);  // an alignment's steps shrink
    Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();
    T_camera_hand.linear() = q_coarse.slerp(share, q_fine).toRotationMatrix();
    T_camera_hand.translation() = (1 - share) * coarse.translation() + share * fine.translation();
    std::vector<LabeledPoint> points = cloud;
    for (LabeledPoint& point : points) point.p = (T_camera_hand.inverse() * point.p.cast<double>()).cast<float>();
    sequence.points_hand.push_back(std::move(points));
  }
  return sequence;
}

/// Of every fourth frame: the plain search takes its time.
std::vector<PointSequence> make_sequences(int max_points) {
  std::vector<PointSequence> sequences;
  for (size_t i = 0; i < data().frames.size(); i += 4)
    sequences.push_back(make_sequence(data().frames[i], max_points));
  return sequences;
}

// One entry an engine: it takes a sequence and returns what it found at each pose, to be compared.
using Found = std::vector<std::vector<ClosestPoint>>;

Found find_plain(const PointSequence& sequence) {
  Found found;
  for (const auto& points : sequence.points_hand) found.push_back(closest_points_plain(points, sequence.surface));
  return found;
}

/// What the search makes of the surface is part of its time.
Found find_fast(const PointSequence& sequence) {
  ClosestPointSearch search(sequence.surface);
  Found found;
  for (const auto& points : sequence.points_hand) found.push_back(search(points));
  return found;
}

bool equal(const std::vector<ClosestPoint>& a, const std::vector<ClosestPoint>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const ClosestPoint& x, const ClosestPoint& y) {
    return x.face == y.face && x.distance == y.distance && x.p_hand == y.p_hand;
  });
}

template <typename Find>
void closest_point(benchmark::State& state, const Find& find, int max_points) {
  const std::vector<PointSequence> sequences = make_sequences(max_points);
  double points = 0;
  for (const PointSequence& sequence : sequences) {
    const Found found = find(sequence), expected = find_plain(sequence);
    if (!std::equal(found.begin(), found.end(), expected.begin(), expected.end(), equal)) {
      return state.SkipWithError("the search differs from the plain one");
    }
    points += static_cast<double>(sequence.points_hand.front().size());
  }
  for (auto _ : state) {
    for (const PointSequence& sequence : sequences) benchmark::DoNotOptimize(find(sequence));
  }
  state.counters["points"] = points / static_cast<double>(sequences.size());
  set_time_each(state, "frame", sequences.size());
}
// The paper profile's number of points, and about as many as the hand has at 0.7 m.
BENCHMARK_CAPTURE(closest_point, plain, find_plain, 1000)
    ->Name("closest_point/plain")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(closest_point, fast, find_fast, 1000)->Name("closest_point/fast")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(closest_point, plain_3000, find_plain, 3000)
    ->Name("closest_point_3000/plain")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(closest_point, fast_3000, find_fast, 3000)
    ->Name("closest_point_3000/fast")
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace glovebench::bench
