#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

/// The effect of other noise seeds on a comparison's row.
struct NoiseFloorEntry {
  std::string experiment;     ///< name or kAllExperiments
  std::string quantity;       ///< metric key
  double spread = 0;          ///< standard deviation between seeds' means
  double minimum_effect = 0;  ///< smallest difference that counts, in the metric's unit
  double detectable = 0;      ///< smallest change that the gate stops in 90% of runs

  friend bool operator==(const NoiseFloorEntry&, const NoiseFloorEntry&) = default;
};

/// Least seeds to measure, per seed of a result.
inline constexpr int kSeedsForEach = 4;
inline constexpr double kLargestFamilyError = 0.1;

/// Made by `glovebench calibrate noise`.
struct NoiseFloor {
  std::string suite;
  int seeds = 0;             ///< measured
  int seeds_per_result = 0;  ///< of the results to compare
  double family_error = 0;   ///< probability that other seeds alone reach a minimum effect
  std::string commit;
  std::string date;  ///< ISO 8601, UTC
  std::vector<NoiseFloorEntry> entries;

  /// Null if absent.
  const NoiseFloorEntry* find(std::string_view experiment, std::string_view quantity) const;
  friend bool operator==(const NoiseFloor&, const NoiseFloor&) = default;
};

/// From a result with many seeds (ci/README.md, "Baselines"). Minimum effects are at least least_effect
/// (gate_rule.h). `detectable` comes from comparisons of disjoint seeds. Rows without values or intervals have no
/// entry. The caller sets the date.
/// Throws: Error for fewer than kSeedsForEach * seeds_per_result seeds, or if experiments' seeds differ.
NoiseFloor measure_noise_floor(const RunResult& result, int seeds_per_result, double family_error = 0.01);

std::string noise_floor_json(const NoiseFloor& floor);
/// Throws: Error.
NoiseFloor read_noise_floor(const std::string& path);
NoiseFloor parse_noise_floor(const std::string& text, const std::string& where);

}  // namespace glovebench::reports
