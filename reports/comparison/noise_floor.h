#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

/// What nothing but another noise seed does to one row of a comparison.
struct NoiseFloorEntry {
  std::string experiment;     ///< to_string of its key, or kAllExperiments
  std::string quantity;       ///< key of a metric
  double spread = 0;          ///< standard deviation over seeds of the mean of one seed
  double minimum_effect = 0;  ///< the smallest difference that counts, in the metric's unit
  double detectable = 0;      ///< the smallest change that the gate stops in 90% of runs with other seeds

  friend bool operator==(const NoiseFloorEntry&, const NoiseFloorEntry&) = default;
};

/// A noise floor is measured from at least this many seeds for each seed of a result.
inline constexpr int kSeedsForEach = 4;
inline constexpr double kLargestFamilyError = 0.1;

/// Measured by `glovebench calibrate noise`, stored beside a baseline.
struct NoiseFloor {
  std::string suite;
  int seeds = 0;             ///< that were measured
  int seeds_per_result = 0;  ///< of the results that it is for
  double family_error = 0;   ///< probability that two results that differ in seeds alone differ by a minimum effect
  std::string commit;
  std::string date;  ///< ISO 8601, UTC
  std::vector<NoiseFloorEntry> entries;

  /// Null if there is no such entry.
  const NoiseFloorEntry* find(std::string_view experiment, std::string_view quantity) const;
  friend bool operator==(const NoiseFloor&, const NoiseFloor&) = default;
};

/// From one result with many seeds (at least kSeedsForEach * seeds_per_result, else Error). The minimum effect is
/// the quantile of Student's t that holds the family error over all entries, times the spread of a difference of
/// two means of `seeds_per_result` seeds; never below the metric's tolerance, and for a share never below two
/// frames. `detectable` comes from comparing draws of disjoint seeds by the very procedure of compare_results, with
/// the same amount added to every frame of one of them. A row without values, or too short for an interval, has no
/// entry. All experiments have the same seeds, else Error. The date is the caller's to fill in.
NoiseFloor measure_noise_floor(const RunResult& result, int seeds_per_result, double family_error = 0.01);

std::string noise_floor_json(const NoiseFloor& floor);
/// Throws Error for whatever noise_floor_json does not write.
NoiseFloor read_noise_floor(const std::string& path);
/// The same for the file's text; `where` names it in errors.
NoiseFloor parse_noise_floor(const std::string& text, const std::string& where);

}  // namespace glovebench::reports
