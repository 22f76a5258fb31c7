// Tracking one device frame: the whole, and what each stage takes of it.

#include <chrono>
#include <map>

#include "bench/bench_data.h"

namespace glovebench::bench {
namespace {

using Clock = std::chrono::steady_clock;

/// Adds up the wall time of each stage that the tracker names.
class StageTimes {
 public:
  void begin(std::string_view stage) {
    const Clock::time_point now = Clock::now();
    if (!current_.empty()) seconds_[current_] += std::chrono::duration<double>(now - start_).count();
    current_ = stage;
    start_ = now;
  }
  const std::map<std::string, double>& seconds() const { return seconds_; }

 private:
  std::map<std::string, double> seconds_;
  std::string current_;
  Clock::time_point start_;
};

void track(benchmark::State& state) {
  const BenchData& d = data();
  Tracker tracker(d.config, d.calibration, d.model, d.database, d.table);
  for (const BenchFrame& frame : d.frames) {
    const TrackResult result = tracker.track(frame.device);
    if (result.T_camera_hand_unfiltered.matrix() != frame.result.T_camera_hand_unfiltered.matrix()) {
      return state.SkipWithError("a frame tracked twice is not the same");
    }
  }
  StageTimes times;
  int64_t frames = 0;
  for (auto _ : state) {
    for (const BenchFrame& frame : d.frames) {
      benchmark::DoNotOptimize(tracker.track(frame.device, [&](std::string_view stage) { times.begin(stage); }));
    }
    frames += static_cast<int64_t>(d.frames.size());
  }
  set_time_each(state, "frame", d.frames.size());
  for (const auto& [stage, seconds] : times.seconds()) {
    state.counters[stage] = seconds / static_cast<double>(frames);
  }
}
BENCHMARK(track)->Name("frame/track")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace glovebench::bench
