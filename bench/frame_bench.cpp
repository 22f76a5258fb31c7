// Tracking one device frame: the whole, and each stage.

#include <chrono>
#include <map>
#include <optional>

#include "bench/bench_data.h"
#include "core/base/math.h"

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

void track(benchmark::State& state, const char* algorithm) {
  const BenchData& d = data();
  TrackerConfig config = d.config;
  config.icp.algorithm = algorithm;
  const Tracker tracker(config, d.calibration, d.model, d.database, d.table);
  for (const BenchFrame& frame : d.frames) {
    const Eigen::Isometry3d found = tracker.track(frame.device).T_camera_hand_unfiltered,
                            again = tracker.track(frame.device).T_camera_hand_unfiltered;
    const bool as_prepared =
        algorithm != d.config.icp.algorithm || found.matrix() == frame.result.T_camera_hand_unfiltered.matrix();
    if (!as_prepared || found.matrix() != again.matrix())
      return state.SkipWithError("a frame tracked twice is not the same");
  }
  StageTimes times;
  std::vector<double> seconds;  // of each frame
  int64_t frames = 0;
  for (auto _ : state) {
    for (const BenchFrame& frame : d.frames) {
      const Clock::time_point start = Clock::now();
      benchmark::DoNotOptimize(tracker.track(frame.device, {}, [&](Stage stage) { times.begin(stage); }));
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
// The paper's alignment, which is the default, and the robust one.
BENCHMARK_CAPTURE(track, horn, "horn")->Name("frame/track")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(track, robust, "robust")->Name("frame/track_robust")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace glovebench::bench
