// Tracking one device frame: the whole, and each stage.

#include <chrono>
#include <map>
#include <optional>

#include "bench/bench_data.h"
#include "core/base/math.h"
#include "core/methods/method.h"
#include "render/label_renderer.h"

namespace glovebench::bench {
namespace {

using Clock = std::chrono::steady_clock;

/// Sums the wall time of each stage.
class StageTimes {
 public:
  void begin(Stage stage) {
    end();
    current_ = stage;
  }
  /// Ends the running stage, if any.
  void end() {
    const Clock::time_point now = Clock::now();
    if (current_) seconds_[*current_] += std::chrono::duration<double>(now - start_).count();
    current_.reset();
    start_ = now;
  }
  const std::map<Stage, double>& seconds() const { return seconds_; }

 private:
  std::map<Stage, double> seconds_;
  std::optional<Stage> current_;
  Clock::time_point start_;
};

/// Each frame as the first one.
void track(benchmark::State& state, std::string_view method, const char* algorithm) {
  const BenchData& d = data();
  TrackerConfig config = d.config;
  config.method = method;
  config.icp.algorithm = algorithm;
  const std::unique_ptr<Method> tracker = find_method(method).make(
      {config, d.calibration, d.model, d.database, d.table, render::label_renderer_factory()});
  for (const BenchFrame& frame : d.frames) {
    const Eigen::Isometry3d found = tracker->track(frame.device, {}).T_camera_hand_unfiltered,
                            again = tracker->track(frame.device, {}).T_camera_hand_unfiltered;
    const bool is_prepared = method == d.config.method && algorithm == d.config.icp.algorithm;
    const bool as_prepared = !is_prepared || found.matrix() == frame.result.T_camera_hand_unfiltered.matrix();
    if (!as_prepared || found.matrix() != again.matrix())
      return state.SkipWithError("a frame tracked twice is not the same");
  }
  StageTimes times;
  std::vector<double> seconds;  // of each frame
  int64_t frames = 0;
  for (auto _ : state) {
    for (const BenchFrame& frame : d.frames) {
      const Clock::time_point start = Clock::now();
      benchmark::DoNotOptimize(tracker->track(frame.device, {}, [&](Stage stage) { times.begin(stage); }));
      times.end();
      seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    }
    frames += static_cast<int64_t>(d.frames.size());
  }
  set_time_each(state, "frame", d.frames.size());
  state.counters["p50_us"] = 1e6 * *quantile_of(seconds, 0.5);
  state.counters["p99_us"] = 1e6 * *quantile_of(seconds, 0.99);
  for (const auto& [stage, stage_seconds] : times.seconds())
    state.counters[std::string(to_string(stage))] = stage_seconds / static_cast<double>(frames);
}
// The paper's method with its alignment, which is the default, and with the robust one.
BENCHMARK_CAPTURE(track, horn, kPaperMethod, "horn")->Name("frame/track")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(track, robust, kPaperMethod, "robust")->Name("frame/track_robust")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(track, articulated, "articulated", "horn")
    ->Name("frame/track_articulated")
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace glovebench::bench
