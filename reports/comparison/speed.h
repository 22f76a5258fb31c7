#pragma once

#include <string>
#include <vector>

namespace glovebench::reports {

/// Measured in one process, comparable between machines.
struct SpeedRatio {
  std::string name;  ///< without /plain and /fast
  double ratio = 0;  ///< plain / fast, medians of CPU time
  double low = 0;    ///< range of repetitions' ratios, without one at each end
  double high = 0;

  friend bool operator==(const SpeedRatio&, const SpeedRatio&) = default;
};

/// Reads speed_json or glovebench_bench's --benchmark_out with at least three repetitions of NAME/plain and
/// NAME/fast. Sorts by name.
/// Throws: Error, also without a pair or for a failed benchmark.
std::vector<SpeedRatio> read_speed_ratios(const std::string& path);
std::vector<SpeedRatio> parse_speed_ratios(const std::string& text, const std::string& where);
std::string speed_json(const std::vector<SpeedRatio>& ratios);

struct SpeedRow {
  std::string name;
  double baseline = 0;
  double candidate = 0;
  double best = 0;   ///< the candidate's `high`
  double limit = 0;  ///< slower if `best` is below
  bool slower = false;
};
/// Half the ratio; below 4, its square root.
double speed_limit(double baseline);

/// In the baseline's order. Ignores new ratios.
/// Throws: Incomparable if the candidate lacks a ratio.
std::vector<SpeedRow> compare_speed(const std::vector<SpeedRatio>& baseline,
                                    const std::vector<SpeedRatio>& candidate, const std::string& candidate_name);

}  // namespace glovebench::reports
