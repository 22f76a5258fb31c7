// From a device frame to the labeled cloud and its tiny images.

#include "bench/bench_data.h"
#include "core/kinect/disparity.h"

namespace glovebench::bench {
namespace {

template <typename T>
double bytes_of(const Image<T>& image) {
  return static_cast<double>(image.size() * sizeof(T));
}

/// Times `stage` on every frame, after its answers have been found right. `touched`: bytes of a frame, read and
/// written.
template <typename Stage, typename IsRight>
void run_stage(benchmark::State& state, Stage stage, IsRight is_right, double touched = 0) {
  for (const BenchFrame& frame : data().frames) {
    if (!is_right(frame, stage(frame))) return state.SkipWithError("the answer is wrong");
  }
  for (auto _ : state) {
    for (const BenchFrame& frame : data().frames) benchmark::DoNotOptimize(stage(frame));
  }
  set_time_each(state, "frame", data().frames.size());
  set_bytes_touched(state, {.far = touched});
}

/// All have images of the same size.
const FrameTrace& first_trace() { return data().frames[0].trace; }

void depth(benchmark::State& state) {
  run_stage(
      state, [](const BenchFrame& frame) { return depth_from_disparity(frame.device.raw_disparity); },
      [](const BenchFrame& frame, const DepthImage& answer) { return answer == frame.trace.depth; },
      bytes_of(data().frames[0].device.raw_disparity) + bytes_of(first_trace().depth));
}
BENCHMARK(depth)->Name("depth_from_disparity")->Unit(benchmark::kMillisecond);

void registration(benchmark::State& state) {
  run_stage(
      state,
      [](const BenchFrame& frame) {
        return register_color(frame.trace.depth, frame.device.color, data().calibration,
                              data().config.registration);
      },
      [](const BenchFrame& frame, const RegisteredImage& answer) {
        return answer.color == frame.trace.mapped.color && answer.has_color == frame.trace.mapped.has_color;
      },
      bytes_of(first_trace().depth) + bytes_of(data().frames[0].device.color) +
          bytes_of(first_trace().mapped.color) + bytes_of(first_trace().mapped.has_color));
}
BENCHMARK(registration)->Name("register")->Unit(benchmark::kMillisecond);

void segmentation(benchmark::State& state) {
  run_stage(
      state, [](const BenchFrame& frame) { return segment(frame.trace.mapped, *data().table); },
      [](const BenchFrame& frame, const LabelImage& answer) {
        // The truth has one label a pixel; borders, noise and the other camera's view cost some.
        size_t right = 0, glove = 0;
        for (size_t i = 0; i < answer.size(); ++i) {
          glove += frame.images.label[i] != 0;
          right += frame.images.label[i] != 0 && frame.images.label[i] == answer[i];
        }
        return answer == frame.trace.labels && right > 0.7 * static_cast<double>(glove);
      },
      bytes_of(first_trace().mapped.color) + bytes_of(first_trace().mapped.has_color) +
          bytes_of(first_trace().labels));
}
BENCHMARK(segmentation)->Name("segment")->Unit(benchmark::kMillisecond);

void majority(benchmark::State& state) {
  run_stage(
      state, [](const BenchFrame& frame) { return majority_filter(frame.trace.labels); },
      [](const BenchFrame& frame, const LabelImage& answer) { return answer.size() == frame.trace.labels.size(); });
}
BENCHMARK(majority)->Name("majority_filter")->Unit(benchmark::kMillisecond);

void cloud(benchmark::State& state) {
  run_stage(
      state,
      [](const BenchFrame& frame) {
        return build_cloud(frame.trace.depth, frame.trace.labels, data().calibration.ir, data().config.volume);
      },
      [](const BenchFrame& frame, const LabeledCloud& answer) { return answer.labels == frame.trace.cloud.labels; },
      bytes_of(first_trace().depth) + bytes_of(first_trace().labels) + bytes_of(first_trace().cloud.labels));
}
BENCHMARK(cloud)->Name("cloud")->Unit(benchmark::kMillisecond);

void components(benchmark::State& state) {
  run_stage(
      state,
      [](const BenchFrame& frame) {
        return component_sizes(frame.trace.cloud, data().config.detection.component_depth_step);
      },
      [](const BenchFrame&, const RecycledVector<int>& answer) { return !answer.empty(); });
}
BENCHMARK(components)->Name("component_sizes")->Unit(benchmark::kMillisecond);

void tiny_images(benchmark::State& state) {
  run_stage(
      state,
      [](const BenchFrame& frame) {
        return make_tiny_images(frame.trace.cloud.labels, bounding_square(frame.trace.cloud.labels),
                                data().config.lookup.cascade);
      },
      [](const BenchFrame& frame, const TinyImages& answer) {
        return answer.images.back() == make_tiny_image_plain(frame.trace.cloud.labels, frame.square, 64);
      });
}
BENCHMARK(tiny_images)->Name("tiny_images")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace glovebench::bench
