#pragma once

#include <string>
#include <vector>

namespace glovebench::reports {

/// Speed relative to the plain implementation in one process. Comparable between machines.
struct SpeedRatio {
  std::string name;  ///< without /plain and /fast
  double ratio = 0;  ///< plain / fast, medians of CPU time
  double low = 0;    ///< extreme ratios of paired repetitions, without one at each end
  double high = 0;

  friend bool operator==(const SpeedRatio&, const SpeedRatio&) = default;
};

/// Reads glovebench_bench's --benchmark_out (Google Benchmark) with at least three repetitions per pair NAME/plain,
/// NAME/fast, or a file of speed_json. Sorted by name.
/// Throws: Error, also without a pair or for a failed benchmark.
std::vector<SpeedRatio> read_speed_ratios(const std::string& path);
std::vector<SpeedRatio> parse_speed_ratios(const std::string& text, const std::string& where);
/// Ratios without machine name and paths.
std::string speed_json(const std::vector<SpeedRatio>& ratios);

struct SpeedRow {
  std::string name;
  double baseline = 0;
  double candidate = 0;
  double best = 0;   ///< the candidate's `high`
  double limit = 0;  ///< slower if `best` is below
  bool slower = false;
};
/// Half the baseline's ratio; below 4, its square root.
double speed_limit(double baseline);

/// In the baseline's order. New ratios are not compared.
/// Throws: Incomparable if the candidate lacks a ratio.
std::vector<SpeedRow> compare_speed(const std::vector<SpeedRatio>& baseline,
                                    const std::vector<SpeedRatio>& candidate, const std::string& candidate_name);

}  // namespace glovebench::reports
