#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/comparison/noise_floor.h"
#include "reports/comparison/pairing.h"

namespace glovebench::reports {

enum class Verdict {
  better,           ///< significant, and at least the minimum effect
  worse,            ///< likewise
  same,             ///< the interval lies within the minimum effect, or all frames are equal
  not_enough_data,  ///< none of these
};
constexpr auto names_of(Verdict) {
  return std::to_array<std::string_view>({"better", "worse", "same", "not enough data"});
}

/// Rows over all experiments: means of their differences.
inline constexpr std::string_view kAllExperiments = "all";

/// Fewer blocks give no reliable interval.
inline constexpr int kFewestBlocks = 5;

struct CompareConfig {
  double family_error = 0.01;  ///< of all intervals together (Bonferroni), (0, 1)
  int block_frames = 16;       ///< least frames of a block, >= 16
  int resamples = 4000;        ///< >= 100
  uint64_t seed = 1;

  double confidence_percent() const { return 100 * (1 - family_error); }
};

struct ComparisonRow {
  std::string experiment;          ///< name or kAllExperiments
  const Metric* metric = nullptr;  ///< gated
  int pairs = 0;                   ///< frames with both values, of all seeds
  int frames = 0;                  ///< of all seeds
  std::optional<double> baseline;  ///< mean over pairs
  std::optional<double> candidate;
  std::optional<double> difference;  ///< candidate - baseline; positive is worse
  std::optional<double> low, high;   ///< simultaneous interval
  int blocks = 0;                    ///< of frames, resampled
  int movement_frames = 0;           ///< of the longest movement, with a pair in any seed
  int trajectories = 1;
  /// Frames of all seeds that would decide, if further movements vary like these.
  int enough_frames = 0;  ///< 0: decided or unknown
  double minimum_effect = 0;
  bool is_measured = false;  ///< minimum_effect is of a noise floor, not the default
  bool is_equal = false;     ///< in every frame; false without pairs
  Verdict verdict = Verdict::not_enough_data;
};

struct ChangedFrame {
  ExperimentKey key;
  uint64_t baseline_seed = 0;
  uint64_t candidate_seed = 0;
  int frame = 0;
  std::optional<double> baseline_vertex_error_mm;  ///< empty if lost
  std::optional<double> candidate_vertex_error_mm;
};

/// Mean differences over seeds with both values.
struct FrameDifferences {
  std::string experiment;
  int first_frame = 0;
  struct OfMetric {
    const Metric* metric;
    std::vector<std::optional<double>> values;
  };
  std::vector<OfMetric> differences;
};

struct ComparedResult {
  std::string name;  ///< file or folder
  std::string program_version;
  std::string commit;
  std::string suite;
  std::string run;  ///< run_name
};

struct Comparison {
  ComparedResult baseline;
  ComparedResult candidate;
  CompareConfig config;
  int seeds = 0;  ///< maximum per experiment
  bool other_seeds = false;
  bool has_noise_floor = false;
  std::vector<std::string> preselected;  ///< metrics; empty: all
  std::vector<ComparisonRow> rows;       ///< kAllExperiments first
  std::vector<FrameDifferences> frames;
  std::vector<ChangedFrame> worst;  ///< most changed first; at most kWorstFrames
  std::vector<ConfigurationChange> configuration;
  std::vector<std::string> only_in_baseline;
  std::vector<std::string> only_in_candidate;
  std::map<std::string, std::string> uncompared_metrics;  ///< key: reason
};
inline constexpr int kWorstFrames = 6;

/// Compares per frame and seed (ci/README.md, "When a change counts"). Student's t has blocks - 1 degrees of
/// freedom. `floor` gives minimum effects; may be null.
/// Throws: Incomparable.
Comparison compare_results(const NamedResult& baseline, const NamedResult& candidate, const NoiseFloor* floor,
                           const PairingOptions& pairing = {}, const CompareConfig& config = {});

std::string comparison_explanation(const Comparison& comparison);

}  // namespace glovebench::reports
