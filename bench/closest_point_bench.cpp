#include "bench/bench_data.h"
#include "core/pose/closest_point.h"

namespace glovebench::bench {
namespace {

/// One frame's points in the hand frame as an alignment sees them: at the coarse pose, then nearer the final one.
struct PointSequence {
  Surface surface;
  std::vector<std::vector<LabeledPoint>> points_hand;
};

constexpr int kIterations = 10;

PointSequence make_sequence(const BenchFrame& frame) {
  const Eigen::Isometry3d& coarse = frame.result.T_camera_hand_coarse;
  const Eigen::Isometry3d& fine = frame.result.T_camera_hand_unfiltered;
  const Eigen::Quaterniond q_coarse(coarse.linear()), q_fine(fine.linear());
  PointSequence sequence{Surface(*data().model, frame.posed, coarse.inverse().translation().cast<float>()), {}};
  const std::vector<LabeledPoint> cloud = subsample(frame.trace.cloud.points, data().config.icp.max_points);
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

std::vector<PointSequence> make_sequences() {
  std::vector<PointSequence> sequences;
  for (const BenchFrame& frame : data().frames) sequences.push_back(make_sequence(frame));
  return sequences;
}

bool equal(const std::vector<ClosestPoint>& a, const std::vector<ClosestPoint>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const ClosestPoint& x, const ClosestPoint& y) {
    return x.face == y.face && x.distance == y.distance && x.p_hand == y.p_hand;
  });
}

void plain(benchmark::State& state) {
  const std::vector<PointSequence> sequences = make_sequences();
  for (auto _ : state) {
    for (const PointSequence& sequence : sequences) {
      for (const auto& points : sequence.points_hand) {
        benchmark::DoNotOptimize(closest_points_plain(points, sequence.surface));
      }
    }
  }
  set_time_each(state, "frame", sequences.size());
}
BENCHMARK(plain)->Name("closest_point/plain")->Unit(benchmark::kMillisecond);

void fast(benchmark::State& state) {
  const std::vector<PointSequence> sequences = make_sequences();
  for (const PointSequence& sequence : sequences) {
    ClosestPointSearch search(sequence.surface);
    for (const auto& points : sequence.points_hand) {
      if (!equal(search(points), closest_points_plain(points, sequence.surface))) {
        return state.SkipWithError("the fast search differs from the plain one");
      }
    }
  }
  for (auto _ : state) {
    for (const PointSequence& sequence : sequences) {
      ClosestPointSearch search(sequence.surface);
      for (const auto& points : sequence.points_hand) benchmark::DoNotOptimize(search(points));
    }
  }
  set_time_each(state, "frame", sequences.size());
}
BENCHMARK(fast)->Name("closest_point/fast")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace glovebench::bench
