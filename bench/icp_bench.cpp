#include "bench/bench_data.h"
#include "core/base/angles.h"
#include "core/base/random.h"
#include "core/pose/icp.h"

namespace glovebench::bench {
namespace {

Alignment align_frame(const BenchFrame& frame, const IcpConfig& config) {
  return align(*data().model, frame.posed, frame.trace.cloud.points, frame.result.T_camera_hand_coarse, config);
}

IcpConfig config_of(IcpAlgorithm algorithm, Implementation implementation, int max_points) {
  IcpConfig config = data().config.icp;
  config.algorithm = algorithm;
  config.implementation = implementation;
  config.max_points = max_points;
  return config;
}

double distance_mm(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return 1000 * (a.translation() - b.translation()).norm();
}
double angle_deg(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return degrees_from_radians(Eigen::Quaterniond(a.linear()).angularDistance(Eigen::Quaterniond(b.linear())));
}

/// Says how far the alignments end from the truth, in the looked-up posture: means over the frames.
void count_errors(benchmark::State& state, const IcpConfig& config) {
  const double count = static_cast<double>(data().frames.size());
  double position_mm = 0, rotation_deg = 0;
  for (const BenchFrame& frame : data().frames) {
    const Alignment alignment = align_frame(frame, config);
    position_mm += distance_mm(alignment.T_camera_hand, frame.hand.T_camera_hand) / count;
    rotation_deg += angle_deg(alignment.T_camera_hand, frame.hand.T_camera_hand) / count;
  }
  state.counters["position_mm"] = position_mm;
  state.counters["rotation_deg"] = rotation_deg;
}

void icp(benchmark::State& state, IcpAlgorithm algorithm, Implementation implementation, int max_points) {
  const IcpConfig config = config_of(algorithm, implementation, max_points);
  const IcpConfig plain = config_of(algorithm, Implementation::plain, max_points);
  std::vector<const BenchFrame*> frames;  // some: the plain search takes its time
  for (size_t i = 0; i < data().frames.size(); i += 4) frames.push_back(&data().frames[i]);
  int iterations = 0;
  for (const BenchFrame* frame : frames) {
    const Alignment alignment = align_frame(*frame, config);
    if (alignment.T_camera_hand.matrix() != align_frame(*frame, plain).T_camera_hand.matrix()) {
      return state.SkipWithError("the alignment differs from the plain one");
    }
    iterations += alignment.iterations;
  }
  for (auto _ : state) {
    for (const BenchFrame* frame : frames) benchmark::DoNotOptimize(align_frame(*frame, config));
  }
  set_time_each(state, "frame", frames.size());
  set_time_each(state, "iteration", iterations);
  if (implementation == Implementation::fast) count_errors(state, config);
}
BENCHMARK_CAPTURE(icp, plain, IcpAlgorithm::horn, Implementation::plain, 1000)
    ->Name("icp/horn/plain")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(icp, fast, IcpAlgorithm::horn, Implementation::fast, 1000)
    ->Name("icp/horn/fast")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(icp, horn_3000, IcpAlgorithm::horn, Implementation::fast, 3000)
    ->Name("icp/horn_3000")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(icp, robust, IcpAlgorithm::robust, Implementation::fast, 1000)
    ->Name("icp/robust")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(icp, robust_3000, IcpAlgorithm::robust, Implementation::fast, 3000)
    ->Name("icp/robust_3000")
    ->Unit(benchmark::kMillisecond);

/// Starts 3 cm and so many degrees from the truth, in the true posture: the share that ends within 2 mm and 1
/// degree of where an alignment that starts at the truth ends.
void convergence(benchmark::State& state, IcpAlgorithm algorithm) {
  const IcpConfig config = config_of(algorithm, Implementation::fast, 3000);
  const auto turn = radians_from_degrees(static_cast<double>(state.range(0)));
  double converged = 0;
  for (auto _ : state) {
    converged = 0;
    for (size_t i = 0; i < data().frames.size(); ++i) {
      const BenchFrame& frame = data().frames[i];
      const PosedHand hand = data().model->pose(frame.hand.posture);
      RandomStream random(1, "icp", static_cast<int64_t>(i), "start");
      const auto direction = [&] {
        return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
      };
      Eigen::Isometry3d start = frame.hand.T_camera_hand;
      start.linear() = Eigen::AngleAxisd(turn, direction()) * start.linear();
      start.translation() += 0.03 * direction();
      const auto from = [&](const Eigen::Isometry3d& T_camera_hand) {
        return align(*data().model, hand, frame.trace.cloud.points, T_camera_hand, config).T_camera_hand;
      };
      const Eigen::Isometry3d solution = from(frame.hand.T_camera_hand), end = from(start);
      converged += distance_mm(end, solution) < 2 && angle_deg(end, solution) < 1;
    }
  }
  state.counters["converged"] = converged / static_cast<double>(data().frames.size());
}
BENCHMARK_CAPTURE(convergence, horn, IcpAlgorithm::horn)
    ->Name("icp/convergence/horn")
    ->ArgName("deg")
    ->DenseRange(5, 35, 10)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(convergence, robust, IcpAlgorithm::robust)
    ->Name("icp/convergence/robust")
    ->ArgName("deg")
    ->DenseRange(5, 35, 10)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

void coarse(benchmark::State& state) {
  for (auto _ : state) {
    for (const BenchFrame& frame : data().frames) {
      benchmark::DoNotOptimize(coarse_pose(*data().model, frame.posed, frame.result.T_camera_hand_coarse.linear(),
                                           frame.trace.cloud.points));
    }
  }
  set_time_each(state, "frame", data().frames.size());
}
BENCHMARK(coarse)->Name("icp/coarse_pose")->Unit(benchmark::kMillisecond);

void pose(benchmark::State& state) {
  for (auto _ : state) {
    for (const BenchFrame& frame : data().frames) {
      benchmark::DoNotOptimize(data().model->pose(frame.result.posture_unfiltered));
    }
  }
  set_time_each(state, "frame", data().frames.size());
}
BENCHMARK(pose)->Name("icp/pose_hand")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace glovebench::bench
