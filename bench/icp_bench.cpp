#include "bench/bench_data.h"
#include "core/pose/icp.h"

namespace glovebench::bench {
namespace {

Alignment align_frame(const BenchFrame& frame) {
  return align(*data().model, frame.posed, frame.trace.cloud.points, frame.result.T_camera_hand_coarse,
               data().config.icp);
}

void icp(benchmark::State& state) {
  int iterations = 0;
  for (const BenchFrame& frame : data().frames) {
    const Alignment alignment = align_frame(frame);
    if (alignment.T_camera_hand.matrix() != frame.result.T_camera_hand_unfiltered.matrix()) {
      return state.SkipWithError("the alignment differs from the tracker's");
    }
    iterations += alignment.iterations;
  }
  for (auto _ : state) {
    for (const BenchFrame& frame : data().frames) benchmark::DoNotOptimize(align_frame(frame));
  }
  set_time_each(state, "frame", data().frames.size());
  set_time_each(state, "iteration", iterations);
}
BENCHMARK(icp)->Name("icp/align")->Unit(benchmark::kMillisecond);

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
