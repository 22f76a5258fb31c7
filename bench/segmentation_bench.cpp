// From a device frame to the labeled cloud and its tiny images.

#include "bench/bench_data.h"
#include "core/kinect/disparity.h"

namespace glovebench::bench {
namespace {

template <typename T>
double bytes_of(const Image<T>& image) {
  return static_cast<double>(image.size() * sizeof(T));
}

/// Times `stage` on every frame, after its answers have been found right. `touched`: bytes of a frame that it reads
/// and writes; all frames have images of the same size.
template <typename Stage, typename IsRight>
void add_stage(const char* name, Stage stage, IsRight is_right, double (*touched)(const BenchFrame&) = nullptr) {
  const auto run = [=](benchmark::State& state) {
    for (const BenchFrame& frame : data().frames)
      if (!is_right(frame, stage(frame))) return state.SkipWithError("the answer is wrong");
    time_each(state, "frame", data().frames, stage);
    if (touched != nullptr) set_bytes_touched(state, {.far = touched(data().frames[0])});
  };
  benchmark::RegisterBenchmark(name, run)->Unit(benchmark::kMillisecond);
}

bool is_segmented(const BenchFrame& frame, const LabelImage& answer) {
  // The truth has one label a pixel; borders, noise and the other camera's view cost some.
  size_t right = 0, glove = 0;
  for (size_t i = 0; i < answer.size(); ++i) {
    glove += frame.images.label[i] != 0;
    right += frame.images.label[i] != 0 && frame.images.label[i] == answer[i];
  }
  return answer == frame.trace.labels && right > 0.7 * static_cast<double>(glove);
}

const int stages_registered = [] {
  add_stage(
      "depth_from_disparity",
      [](const BenchFrame& frame) { return depth_from_disparity(frame.device.raw_disparity); },
      [](const BenchFrame& frame, const DepthImage& answer) { return answer == frame.trace.depth; },
      [](const BenchFrame& frame) { return bytes_of(frame.device.raw_disparity) + bytes_of(frame.trace.depth); });
  add_stage(
      "register",
      [](const BenchFrame& frame) {
        return register_color(frame.trace.depth, frame.device.color, data().calibration,
                              data().config.registration);
      },
      [](const BenchFrame& frame, const RegisteredImage& answer) {
        return answer.color == frame.trace.mapped.color && answer.has_color == frame.trace.mapped.has_color;
      },
      [](const BenchFrame& frame) {
        return bytes_of(frame.trace.depth) + bytes_of(frame.device.color) + bytes_of(frame.trace.mapped.color) +
               bytes_of(frame.trace.mapped.has_color);
      });
  add_stage(
      "segment", [](const BenchFrame& frame) { return segment(frame.trace.mapped, *data().table); }, is_segmented,
      [](const BenchFrame& frame) {
        return bytes_of(frame.trace.mapped.color) + bytes_of(frame.trace.mapped.has_color) +
               bytes_of(frame.trace.labels);
      });
  add_stage(
      "majority_filter", [](const BenchFrame& frame) { return majority_filter(frame.trace.labels); },
      [](const BenchFrame& frame, const LabelImage& answer) {
        return answer == majority_filter(frame.trace.labels);
      });
  add_stage(
      "surface_majority",
      [](const BenchFrame& frame) { return surface_majority(frame.trace.labels, frame.trace.depth); },
      [](const BenchFrame& frame, const LabelImage& answer) {
        return answer == surface_majority(frame.trace.labels, frame.trace.depth);
      });
  add_stage(
      "cloud",
      [](const BenchFrame& frame) {
        return build_cloud(frame.trace.depth, frame.trace.labels, data().calibration.ir, data().config.volume);
      },
      [](const BenchFrame& frame, const LabeledCloud& answer) { return answer.labels == frame.trace.cloud.labels; },
      [](const BenchFrame& frame) {
        return bytes_of(frame.trace.depth) + bytes_of(frame.trace.labels) + bytes_of(frame.trace.cloud.labels);
      });
  add_stage(
      "component_sizes",
      [](const BenchFrame& frame) {
        return component_sizes(frame.trace.cloud, data().config.detection.component_depth_step);
      },
      [](const BenchFrame&, const RecycledVector<int>& answer) { return !answer.empty(); });
  add_stage(
      "tiny_images",
      [](const BenchFrame& frame) {
        return make_tiny_images(frame.trace.cloud.labels, bounding_square(frame.trace.cloud.labels),
                                data().config.lookup.cascade);
      },
      [](const BenchFrame& frame, const TinyImages& answer) {
        return answer.images.back() == make_tiny_image_plain(frame.trace.cloud.labels, frame.square, 64);
      });
  return 0;
}();

}  // namespace
}  // namespace glovebench::bench
