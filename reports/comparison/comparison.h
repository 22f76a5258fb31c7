#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/comparison/noise_floor.h"
#include "reports/comparison/pairing.h"

namespace glovebench::reports {

/// Of a candidate against a baseline.
enum class Verdict {
  better,           ///< significantly, and by at least the minimum effect
  worse,            ///< the same in the other direction
  same,             ///< the interval lies within the minimum effect on both sides
  not_enough_data,  ///< none of these can be said
};
constexpr auto names_of(Verdict) {
  return std::to_array<std::string_view>({"better", "worse", "same", "not enough data"});
}

/// Name of the rows over all experiments: the mean of the experiments' differences.
inline constexpr std::string_view kAllExperiments = "all";

struct CompareConfig {
  double family_error = 0.01;  ///< of all intervals together (Bonferroni), in (0, 1)
  int block_frames = 16;       ///< successive frames are not independent: at least so many make a block, >= 16
  int resamples = 4000;        ///< >= 100
  uint64_t seed = 1;           ///< of the bootstrap
};

/// One metric of one experiment, or of all.
struct ComparisonRow {
  std::string experiment;          ///< to_string of its key, or kAllExperiments
  const Metric* metric = nullptr;  ///< gated
  int pairs = 0;                   ///< frames of all seeds that have the value in both
  int frames = 0;                  ///< frames of all seeds
  std::optional<double> baseline;  ///< mean over the pairs
  std::optional<double> candidate;
  std::optional<double> difference;  ///< candidate - baseline: above zero is worse
  std::optional<double> low, high;   ///< simultaneous interval of the difference
  int blocks = 0;                    ///< of frames, that were resampled
  double minimum_effect = 0;
  bool is_measured = false;  ///< the minimum effect: by a noise floor; otherwise it is a default
  Verdict verdict = Verdict::not_enough_data;
};

/// A frame whose error changed for the worse.
struct ChangedFrame {
  ExperimentKey key;
  uint64_t baseline_seed = 0;
  uint64_t candidate_seed = 0;
  int frame = 0;
  std::optional<double> baseline_vertex_error_mm;  ///< empty where the frame was lost
  std::optional<double> candidate_vertex_error_mm;
};

/// The paired differences of one experiment, frame by frame: mean over the seeds that have both.
struct FrameDifferences {
  std::string experiment;
  int first_frame = 0;
  struct OfMetric {
    const Metric* metric;
    std::vector<std::optional<double>> values;
  };
  std::vector<OfMetric> differences;
};

/// A field of the effective configurations that differs.
struct ConfigurationChange {
  std::string field;     ///< e.g. "icp.max_iterations"
  std::string baseline;  ///< as JSON; empty where there is none
  std::string candidate;
};

struct ComparedResult {
  std::string name;  ///< file or folder
  std::string program_version;
  std::string commit;
  std::string suite;
};

struct Comparison {
  ComparedResult baseline;
  ComparedResult candidate;
  CompareConfig config;
  int seeds = 0;             ///< of each experiment (the most, where they differ)
  bool other_seeds = false;  ///< the noise seeds differ, so that the frames' noise is not paired
  bool has_noise_floor = false;
  std::vector<ComparisonRow> rows;  ///< first those over all experiments, then experiment by experiment
  std::vector<FrameDifferences> frames;
  std::vector<ChangedFrame> worst;  ///< the most changed first; at most kWorstFrames, none of them unchanged
  std::vector<ConfigurationChange> configuration;
  std::vector<std::string> only_in_baseline;
  std::vector<std::string> only_in_candidate;
  std::map<std::string, std::string> uncompared_metrics;  ///< key: why
};
inline constexpr int kWorstFrames = 6;

/// Compares two results, frame by frame and seed by seed. The sequences are fixed strata: blocks of frames (at
/// least block_frames, all of about one length) and seeds are resampled within them (Rao and Wu's rescaled
/// bootstrap: one fewer is drawn than there are), experiments on the same trajectory share their draws. An interval
/// is the difference -+ Student's t times the bootstrap's standard error, with one degree of freedom fewer than
/// blocks, at the level that holds the family error over all rows. Minimum effects come from the noise floor where
/// it has them. Throws Incomparable.
Comparison compare_results(const NamedResult& baseline, const NamedResult& candidate, const NoiseFloor* floor,
                           const PairingOptions& pairing = {}, const CompareConfig& config = {});

/// What the intervals and verdicts mean, in a paragraph of plain text.
std::string comparison_explanation(const Comparison& comparison);

}  // namespace glovebench::reports
