// Both alignments, plain and fast, and PCL's.

#include <fmt/format.h>

#include <algorithm>

#include "bench/bench_data.h"
#include "bench/peers/peers.h"
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/pose/alignment.h"
#include "core/pose/alignments/robust_alignment.h"
#include "core/pose/surface_matcher.h"

namespace glovebench::bench {
namespace {

Alignment align_frame(const BenchFrame& frame, const IcpConfig& config) {
  return align(*data().model, frame.posed, frame.trace.cloud.points, frame.result.T_camera_hand_coarse, config);
}

IcpConfig config_of(const char* algorithm, Implementation implementation, int max_points) {
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

/// Mean distance to the truth, in the looked-up posture.
struct Errors {
  double position_mm = 0;
  double rotation_deg = 0;
};

template <typename Align>
Errors mean_errors(const Align& align_one) {
  Errors errors;
  const auto count = static_cast<double>(data().frames.size());
  for (const BenchFrame& frame : data().frames) {
    const Eigen::Isometry3d T_camera_hand = align_one(frame).T_camera_hand;
    errors.position_mm += distance_mm(T_camera_hand, frame.hand.T_camera_hand) / count;
    errors.rotation_deg += angle_deg(T_camera_hand, frame.hand.T_camera_hand) / count;
  }
  return errors;
}

void set_errors(benchmark::State& state, const Errors& errors) {
  state.counters["position_mm"] = errors.position_mm;
  state.counters["rotation_deg"] = errors.rotation_deg;
}

/// Counts the iterations of all frames. Empty if an alignment differs from the plain one.
std::optional<int> iterations_like_plain(const std::vector<const BenchFrame*>& frames, const IcpConfig& config) {
  IcpConfig plain = config;
  plain.implementation = Implementation::plain;
  int iterations = 0;
  for (const BenchFrame* frame : frames) {
    const Alignment alignment = align_frame(*frame, config);
    if (config.implementation != Implementation::plain &&
        alignment.T_camera_hand.matrix() != align_frame(*frame, plain).T_camera_hand.matrix())
      return {};
    iterations += alignment.iterations;
  }
  return iterations;
}

void icp(benchmark::State& state, const char* algorithm, Implementation implementation, int max_points) {
  const IcpConfig config = config_of(algorithm, implementation, max_points);
  const std::vector<const BenchFrame*> frames = some_frames();
  const std::string name = fmt::format("{} {} {}", algorithm, static_cast<int>(implementation), max_points);
  const auto iterations = once(name, [&] { return iterations_like_plain(frames, config); });
  if (!iterations) return state.SkipWithError("the alignment differs from the plain one");
  time_each(state, "frame", frames, [&](const BenchFrame* frame) { return align_frame(*frame, config); });
  set_time_each(state, "iteration", static_cast<size_t>(*iterations));
  if (implementation == Implementation::fast)
    set_errors(state, mean_errors([&](const BenchFrame& frame) { return align_frame(frame, config); }));
}
BENCHMARK_CAPTURE(icp, plain, "horn", Implementation::plain, 1000)
    ->Name("icp/horn/plain")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(icp, fast, "horn", Implementation::fast, 1000)
    ->Name("icp/horn/fast")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(icp, horn_3000, "horn", Implementation::fast, 3000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(icp, robust, "robust", Implementation::fast, 1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(icp, robust_3000, "robust", Implementation::fast, 3000)->Unit(benchmark::kMillisecond);

/// With the same points, the same start and the same rule to stop as Horn's. Its pairs are others, since it knows
/// no colors and no triangles: so is its answer, whose errors are shown, and which must be nearer than the start.
void icp_peer(benchmark::State& state, AlignPeer peer, int max_points) {
  if (peer == nullptr) return state.SkipWithError(kMissing);
  const IcpConfig config = config_of("horn", Implementation::fast, max_points);
  const auto align_one = [&](const BenchFrame& frame) {
    const Eigen::Isometry3d& coarse = frame.result.T_camera_hand_coarse;
    const Surface surface(*data().model, frame.posed, viewpoint_hand(coarse));
    return peer(surface, subsample(frame.trace.cloud.points, max_points), coarse, config);
  };
  const Errors errors = mean_errors(align_one),
               at_start = mean_errors([](const BenchFrame&frame) {
                 return Alignment{.T_camera_hand = frame.result.T_camera_hand_coarse};
               });
  if (!(errors.position_mm < at_start.position_mm)) return state.SkipWithError("it ends farther than it starts");
  const std::vector<const BenchFrame*> frames = some_frames();
  int iterations = 0;
  for (const BenchFrame* frame : frames) iterations += align_one(*frame).iterations;
  time_each(state, "frame", frames, [&](const BenchFrame* frame) { return align_one(*frame); });
  set_time_each(state, "iteration", iterations);
  set_errors(state, errors);
}
// Not icp/horn/pcl: another problem, so no ratio.
BENCHMARK_CAPTURE(icp_peer, pcl, kPcl, 1000)->Name("icp/pcl")->Unit(benchmark::kMillisecond);

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Errors alone, in the looked-up posture. Medians, too: generated movements have frames whose start is far off.
template <typename Align>
void set_error_statistics(benchmark::State& state, const Align& align_one) {
  for (auto _ : state) {
    set_errors(state, mean_errors(align_one));
    std::vector<double> distances_mm, angles_deg;
    for (const BenchFrame& frame : data().frames) {
      const Eigen::Isometry3d T_camera_hand = align_one(frame).T_camera_hand;
      distances_mm.push_back(distance_mm(T_camera_hand, frame.hand.T_camera_hand));
      angles_deg.push_back(angle_deg(T_camera_hand, frame.hand.T_camera_hand));
    }
    state.counters["median_position_mm"] = median(std::move(distances_mm));
    state.counters["median_rotation_deg"] = median(std::move(angles_deg));
  }
  state.counters["frames"] = static_cast<double>(data().frames.size());
}

/// Errors of the robust alignment; the argument is the width of its weights in percent of the textbook's.
void robust_errors(benchmark::State& state) {
  const IcpConfig config = config_of("robust", Implementation::fast, 1000);
  set_error_statistics(state, [&](const BenchFrame& frame) {
    return align_robust(*data().model, frame.posed, subsample(frame.trace.cloud.points, config.max_points),
                        frame.result.T_camera_hand_coarse, config, 0.01 * static_cast<double>(state.range(0)));
  });
}
BENCHMARK(robust_errors)
    ->Name("icp/errors/robust")
    ->ArgName("width_percent")
    ->ArgsProduct({{40, 50, 60, 70, 80, 100}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

void horn_errors(benchmark::State& state) {
  const IcpConfig config = config_of("horn", Implementation::fast, 1000);
  set_error_statistics(state, [&](const BenchFrame& frame) { return align_frame(frame, config); });
}
BENCHMARK(horn_errors)->Name("icp/errors/horn")->Iterations(1)->Unit(benchmark::kMillisecond);

/// Starts 3 cm and so many degrees from the truth, in the true posture: the share that ends within 2 mm and 1
/// degree of where an alignment that starts at the truth ends.
void convergence(benchmark::State& state, const char* algorithm) {
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
void set_angles(benchmark::internal::Benchmark* each) {
  each->ArgName("deg")->DenseRange(5, 35, 10)->Iterations(1)->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(convergence, horn, "horn")->Name("icp/convergence/horn")->Apply(set_angles);
BENCHMARK_CAPTURE(convergence, robust, "robust")->Name("icp/convergence/robust")->Apply(set_angles);

void coarse(benchmark::State& state) {
  time_each(state, "frame", data().frames, [](const BenchFrame& frame) {
    return coarse_pose(*data().model, frame.posed, frame.result.T_camera_hand_coarse.linear(),
                       frame.trace.cloud.points);
  });
}
BENCHMARK(coarse)->Name("icp/coarse_pose")->Unit(benchmark::kMillisecond);

void pose(benchmark::State& state) {
  time_each(state, "frame", data().frames,
            [](const BenchFrame& frame) { return data().model->pose(frame.result.posture_unfiltered); });
}
BENCHMARK(pose)->Name("icp/pose_hand")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace glovebench::bench
