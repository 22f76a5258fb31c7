#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace glovebench::bench {

/// What the repetitions of one benchmark came to.
struct Measured {
  std::map<int64_t, double> seconds;     ///< CPU time for one item (a frame, a view), by the repetition's number
  bool missing = false;                  ///< this build lacks the library
  double near_bytes = 0, far_bytes = 0;  ///< that one item touches at least (set_bytes_touched); 0 if not said
};
/// By the benchmark's name.
using Measurements = std::map<std::string, Measured>;

/// How many times longer an engine takes than our fast one, in the benchmarks STAGE/ENGINE and STAGE/fast of one
/// process. The plain implementation is an engine, too.
struct EngineRatio {
  std::string stage, engine;
  bool missing = false;                  ///< then the numbers are 0
  double seconds = 0, fast_seconds = 0;  ///< medians
  double ratio = 0;                      ///< of the medians
  double low = 0, high = 0;              ///< smallest and largest ratio of the same repetition of both
};
/// By stage, the plain one first.
std::vector<EngineRatio> engine_ratios(const Measurements& measurements);

/// How far a stage is from the time in which memory could deliver what it touches.
struct StageFloor {
  std::string benchmark;
  double bytes = 0;
  double floor_seconds = 0;
  double seconds = 0;  ///< median
};
/// Where the processor's first caches, and what lies behind them, are read.
inline const std::string kNearBandwidth = "read_bandwidth/near", kFarBandwidth = "read_bandwidth/far";
/// Of all benchmarks that say what they touch; none if the two above were not run.
std::vector<StageFloor> stage_floors(const Measurements& measurements);

/// One line a ratio, to read in a terminal.
std::string ratio_lines(const std::vector<EngineRatio>& ratios);
/// Both tables as Markdown.
std::string speed_markdown(const Measurements& measurements);

}  // namespace glovebench::bench
