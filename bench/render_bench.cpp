// What the evaluator spends on a frame: the rendered images and the sensor's noise.

#include "bench/bench_data.h"
#include "render/label_renderer.h"

namespace glovebench::bench {
namespace {

void rgbd_frame(benchmark::State& state) {
  render::RgbdRenderer renderer(data().calibration, data().model, render::SceneConfig{});
  for (const BenchFrame& frame : data().frames) {
    const render::RgbdImages images =
        renderer.render(data().model->pose(frame.hand.posture), frame.hand.T_camera_hand, {});
    if (images.color != frame.images.color || images.depth != frame.images.depth) {
      return state.SkipWithError("a frame drawn twice is not the same");
    }
  }
  for (auto _ : state) {
    for (const BenchFrame& frame : data().frames) {
      benchmark::DoNotOptimize(
          renderer.render(data().model->pose(frame.hand.posture), frame.hand.T_camera_hand, {}));
    }
  }
  set_time_each(state, "frame", data().frames.size());
}
BENCHMARK(rgbd_frame)->Name("render/rgbd_frame")->Unit(benchmark::kMillisecond);

void run_noise(benchmark::State& state, const char* depth_noise) {
  render::NoiseConfig noise;
  noise.depth = depth_noise;
  for (const BenchFrame& frame : data().frames) {
    const render::FrameKey key{1, "noise", 0};
    const DepthImage a = render::add_depth_noise(frame.images.depth, data().calibration.ir, noise, key);
    if (a == frame.images.depth) return state.SkipWithError("the noise changes nothing");
  }
  int64_t number = 0;
  for (auto _ : state) {
    for (const BenchFrame& frame : data().frames) {
      const render::FrameKey key{1, "noise", number++};
      benchmark::DoNotOptimize(render::add_depth_noise(frame.images.depth, data().calibration.ir, noise, key));
    }
  }
  set_time_each(state, "frame", data().frames.size());
}

void gradient_noise(benchmark::State& state) { run_noise(state, "gradient"); }
BENCHMARK(gradient_noise)->Name("render/depth_noise_gradient")->Unit(benchmark::kMillisecond);

void kinect_noise(benchmark::State& state) { run_noise(state, "kinect"); }
BENCHMARK(kinect_noise)->Name("render/depth_noise_kinect")->Unit(benchmark::kMillisecond);

void color_noise(benchmark::State& state) {
  int64_t number = 0;
  for (auto _ : state) {
    for (const BenchFrame& frame : data().frames) {
      benchmark::DoNotOptimize(
          render::add_color_noise(frame.images.color, render::kColorSigma_gray, {1, "noise", number++}));
    }
  }
  set_time_each(state, "frame", data().frames.size());
}
BENCHMARK(color_noise)->Name("render/color_noise")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace glovebench::bench
