// The time that a frame takes to a tracker that is a program, and that its answer takes back.

#include "bench/bench_data.h"
#include "core/adapters/process/process_method.h"

namespace glovebench::bench {
namespace {

/// Reads frames and answers at once.
constexpr const char* kEcho = R"(exec:python3 -c '
import json, sys
frames = sys.stdin.buffer
frames.readline()
while line := frames.readline():
    frame = json.loads(line)
    frames.read(frame["depth_bytes"] + frame["rgb_bytes"])
    print(json.dumps({"frame": frame["frame"], "status": "no_hand"}), flush=True)')";

void round_trip(benchmark::State& state) {
  const BenchData& d = data();
  TrackerConfig config = d.config;
  config.method = kEcho;
  const std::unique_ptr<Method> method = make_process_method({config, d.calibration, d.model, {}, {}});
  for (const BenchFrame& frame : d.frames)  // also starts the program
    if (method->track(frame.device).status != TrackStatus::no_hand)
      return state.SkipWithError("an answer is missing");
  time_each(state, "frame", d.frames, [&](const BenchFrame& frame) { return method->track(frame.device); });
}
BENCHMARK(round_trip)->Name("process/round_trip")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace glovebench::bench
