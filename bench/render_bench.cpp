// What the evaluator spends on a frame: the rendered images and the sensor's noise.

#include "bench/bench_data.h"
#include "render/rgbd_renderer.h"

namespace glovebench::bench {
namespace {

void rgbd_frame(benchmark::State& state) {
  render::RgbdRenderer renderer(data().calibration, data().model, render::SceneConfig{});
  const auto render_frame = [&](const BenchFrame& frame) {
    return renderer.render(data().model->pose(frame.hand.posture), frame.hand.T_camera_hand, {});
  };
  for (const BenchFrame& frame : data().frames) {
    const render::RgbdImages images = render_frame(frame);
    if (images.color != frame.images.color || images.depth != frame.images.depth)
      return state.SkipWithError("a frame drawn twice is not the same");
  }
  time_each(state, "frame", data().frames, render_frame);
}
BENCHMARK(rgbd_frame)->Name("render/rgbd_frame")->Unit(benchmark::kMillisecond);

void depth_noise(benchmark::State& state, const char* model) {
  render::NoiseConfig noise;
  noise.depth = model;
  const auto with_noise = [&](const BenchFrame& frame, int64_t number) {
    return render::add_depth_noise(frame.images.depth, data().calibration.ir, noise, {1, "noise", number});
  };
  for (const BenchFrame& frame : data().frames)
    if (with_noise(frame, 0) == frame.images.depth) return state.SkipWithError("the noise changes nothing");
  int64_t number = 0;
  time_each(state, "frame", data().frames, [&](const BenchFrame& frame) { return with_noise(frame, number++); });
}
BENCHMARK_CAPTURE(depth_noise, gradient, "gradient")
    ->Name("render/depth_noise_gradient")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(depth_noise, kinect, "kinect")->Name("render/depth_noise_kinect")->Unit(benchmark::kMillisecond);

void color_noise(benchmark::State& state) {
  int64_t number = 0;
  time_each(state, "frame", data().frames, [&](const BenchFrame& frame) {
    return render::add_color_noise(frame.images.color, render::kColorSigma_gray, {1, "noise", number++});
  });
}
BENCHMARK(color_noise)->Name("render/color_noise")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace glovebench::bench
