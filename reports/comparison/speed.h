#pragma once

#include <string>
#include <vector>

namespace glovebench::reports {

/// How many times faster than the plain implementation, both timed in one process: what of a speed can be compared
/// between machines.
struct SpeedRatio {
  std::string name;  ///< of the benchmark, without /plain and /fast
  double ratio = 0;  ///< plain / fast, of the medians of CPU times
  double low = 0;    ///< smallest and largest ratio of a pair of repetitions but for one at each end
  double high = 0;

  friend bool operator==(const SpeedRatio&, const SpeedRatio&) = default;
};

/// From a JSON file of glovebench_bench (Google Benchmark's --benchmark_out), in which every pair NAME/plain,
/// NAME/fast has at least three repetitions (aggregates are not counted as such), or from one that speed_json
/// wrote; by name. Throws Error, also if there is no pair or a benchmark failed.
std::vector<SpeedRatio> read_speed_ratios(const std::string& path);
std::vector<SpeedRatio> parse_speed_ratios(const std::string& text, const std::string& where);
/// What a baseline keeps of a benchmark's file: the ratios, without the machine's name and paths.
std::string speed_json(const std::vector<SpeedRatio>& ratios);

/// One ratio against the baseline's.
struct SpeedRow {
  std::string name;
  double baseline = 0;
  double candidate = 0;
  double best = 0;   ///< the candidate's `high`
  double limit = 0;  ///< what is no faster than this at best has become slower
  bool slower = false;
};
/// Half of the baseline's ratio: other processors, and other work on this one, move a ratio by less. Where that is
/// little more than 1, the geometric middle between both.
double speed_limit(double baseline);

/// In the baseline's order; ratios that only the candidate has are new and not compared. Throws Incomparable if the
/// candidate lacks a ratio of the baseline's.
std::vector<SpeedRow> compare_speed(const std::vector<SpeedRatio>& baseline,
                                    const std::vector<SpeedRatio>& candidate, const std::string& candidate_name);

}  // namespace glovebench::reports
