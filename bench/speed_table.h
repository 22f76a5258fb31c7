#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace glovebench::bench {

struct Measured {
  std::map<int64_t, double> seconds;  ///< CPU time per item, by repetition
  bool missing = false;
  double near_bytes = 0, far_bytes = 0;  ///< per item; 0: unknown
};
using Measurements = std::map<std::string, Measured>;

/// Compares STAGE/ENGINE with STAGE/fast.
struct EngineRatio {
  std::string stage, engine;
  bool missing = false;                  ///< numbers are 0
  double seconds = 0, fast_seconds = 0;  ///< medians
  double ratio = 0;
  double low = 0, high = 0;  ///< over repetitions
};
/// By stage, plain first.
std::vector<EngineRatio> engine_ratios(const Measurements& measurements);

/// A stage's time, and the least time to read its bytes.
struct StageFloor {
  std::string benchmark;
  double bytes = 0;
  double floor_seconds = 0;
  double seconds = 0;  ///< median
};
inline const std::string kNearBandwidth = "read_bandwidth/near", kFarBandwidth = "read_bandwidth/far";
/// Empty without both bandwidths.
std::vector<StageFloor> stage_floors(const Measurements& measurements);

std::string ratio_lines(const std::vector<EngineRatio>& ratios);
std::string speed_markdown(const Measurements& measurements);

}  // namespace glovebench::bench
