#include "reports/comparison/comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "reports/comparison/comparison_rows.h"

namespace glovebench::reports {
namespace {

using nlohmann::json;

ComparedResult compared(const NamedResult& named) {
  const RunResult& result = named.result;
  return {named.name, result.program_version, result.commit, result.suite, run_name(result)};
}

bool have_other_seeds(const Pairing& pairing) {
  for (const auto& [baseline, candidate] : pairing.experiments)
    if (!std::ranges::equal(baseline->runs, candidate->runs, {}, &SeedRun::seed, &SeedRun::seed)) return true;
  return false;
}

FrameDifferences frame_differences(const std::vector<const Metric*>& metrics, const ExperimentResult& baseline,
                                   const ExperimentResult& candidate) {
  FrameDifferences result;
  result.experiment = to_string(baseline.key);
  if (baseline.runs.empty() || baseline.runs.front().frames.empty()) return result;
  result.first_frame = baseline.runs.front().frames.front().frame;
  for (const Metric* metric : metrics) {
    const auto by_seed = paired_differences(*metric, baseline.runs, candidate.runs).by_seed;
    auto& differences = result.differences.emplace_back(FrameDifferences::OfMetric{metric, {}}).values;
    for (size_t f = 0; f < by_seed.front().size(); ++f) {
      std::vector<double> values;
      for (const auto& row : by_seed)
        if (row[f]) values.push_back(*row[f]);
      differences.push_back(mean(values));
    }
  }
  return result;
}

/// Adds all values by their path: "icp.max_iterations".
void add_flat(const json& configuration, const std::string& prefix, std::map<std::string, std::string>& fields) {
  const json flat = configuration.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    std::string field = pointer.substr(std::min<size_t>(1, pointer.size()));
    std::ranges::replace(field, '/', '.');
    fields[prefix + field] = value.dump(-1, ' ', true, json::error_handler_t::replace);
  }
}

/// The tracker's configuration (or what `score` did), and that of the cameras unless they are the program's own.
std::map<std::string, std::string> flat_configuration(const RunResult& result) {
  std::map<std::string, std::string> fields;
  const auto add = [&](const char* part, const std::string& prefix) {
    const auto found = result.configuration.find(part);
    if (found != result.configuration.end() && found->is_object()) add_flat(*found, prefix, fields);
  };
  add("tracker", "");
  add("calibration", "calibration.");
  add("score", "score.");
  return fields;
}

std::vector<ConfigurationChange> configuration_changes(const RunResult& baseline, const RunResult& candidate) {
  std::map<std::string, ConfigurationChange> fields;
  for (const auto& [field, value] : flat_configuration(baseline)) fields[field].baseline = value;
  for (const auto& [field, value] : flat_configuration(candidate)) fields[field].candidate = value;
  std::vector<ConfigurationChange> changes;
  for (auto& [field, change] : fields)
    if (change.baseline != change.candidate) changes.push_back({field, change.baseline, change.candidate});
  return changes;
}

constexpr double kLost_mm = 50;
constexpr double kUnchanged_mm = 0.01;
constexpr int kDistinctFrames = 8;

double change_of(const ChangedFrame& frame) {
  return frame.candidate_vertex_error_mm.value_or(kLost_mm) - frame.baseline_vertex_error_mm.value_or(kLost_mm);
}

std::vector<ChangedFrame> frames_that_got_worse(const Pairing& pairing) {
  std::vector<ChangedFrame> frames;
  for (const auto& [baseline, candidate] : pairing.experiments) {
    for (size_t s = 0; s < baseline->runs.size(); ++s) {
      const SeedRun &before = baseline->runs[s], &after = candidate->runs[s];
      for (size_t f = 0; f < before.frames.size(); ++f) {
        const ChangedFrame frame = {baseline->key,
                                    before.seed,
                                    after.seed,
                                    before.frames[f].frame,
                                    before.frames[f]["vertex_error_mm"],
                                    after.frames[f]["vertex_error_mm"]};
        if (change_of(frame) > kUnchanged_mm) frames.push_back(frame);
      }
    }
  }
  return frames;
}

/// The frames whose vertex error grew most, by more than 0.01 mm, at most kWorstFrames. A lost frame counts as 50
/// mm, the bound of a covered frame. Frames close together in one experiment show the same failure, so only the
/// worst is taken. Empty if a result has no vertex errors.
std::vector<ChangedFrame> worst_frames(const Pairing& pairing) {
  if (std::ranges::find(pairing.metrics, "vertex_error_mm", &Metric::key) == pairing.metrics.end()) return {};
  std::vector<ChangedFrame> frames = frames_that_got_worse(pairing);
  std::ranges::stable_sort(frames, std::greater(), change_of);
  std::vector<ChangedFrame> worst;
  for (const ChangedFrame& frame : frames) {
    if (worst.size() == kWorstFrames) break;
    const bool shown = std::ranges::any_of(worst, [&](const ChangedFrame& other) {
      return other.key == frame.key && std::abs(other.frame - frame.frame) <= kDistinctFrames;
    });
    if (!shown) worst.push_back(frame);
  }
  return worst;
}

}  // namespace

Comparison compare_results(const NamedResult& baseline, const NamedResult& candidate, const NoiseFloor* floor,
                           const PairingOptions& pairing_options, const CompareConfig& config) {
  const Pairing pairing = pair_results(baseline, candidate, pairing_options);
  Draws draws(config.seed, config.resamples);
  Comparison comparison;
  comparison.baseline = compared(baseline);
  comparison.candidate = compared(candidate);
  comparison.config = config;
  comparison.other_seeds = have_other_seeds(pairing);
  comparison.has_noise_floor = floor != nullptr;
  if (floor && floor->suite != candidate.result.suite)
    throw Incomparable("noise floor", "suite", floor->suite, candidate.result.suite + ", as the candidate's");
  comparison.rows = comparison_rows(pairing, floor, config, draws);
  for (const auto& [before, after] : pairing.experiments) {
    comparison.seeds = std::max(comparison.seeds, static_cast<int>(before->runs.size()));
    comparison.frames.push_back(frame_differences(pairing.metrics, *before, *after));
  }
  comparison.worst = worst_frames(pairing);
  comparison.preselected = pairing_options.metrics;
  comparison.configuration = pairing.across;
  std::ranges::move(configuration_changes(baseline.result, candidate.result),
                    std::back_inserter(comparison.configuration));
  comparison.only_in_baseline = pairing.only_in_baseline;
  comparison.only_in_candidate = pairing.only_in_candidate;
  comparison.uncompared_metrics = uncompared_metrics(baseline.result.protocol, candidate.result.protocol);
  return comparison;
}

namespace {

std::string floor_sentence(const Comparison& comparison) {
  const auto measured = std::ranges::count(comparison.rows, true, &ComparisonRow::is_measured);
  const auto rows = std::ssize(comparison.rows);
  if (measured == rows) return "measured over other noise seeds";
  if (measured == 0) return "a default: no noise floor was measured";
  return fmt::format("measured over other noise seeds for {} rows, a default for the other {}", measured,
                     rows - measured);
}

}  // namespace

std::string comparison_explanation(const Comparison& comparison) {
  const CompareConfig& config = comparison.config;
  const std::string noise =
      comparison.other_seeds
          ? "The two were run with other noise seeds, so their frames share the movement but not the noise. "
          : "";
  const std::string choice = comparison.preselected.empty() ? ""
                                                            : fmt::format("The metrics were chosen before: {}. ",
                                                                          fmt::join(comparison.preselected, ", "));
  return fmt::format(
      "Differences are candidate minus baseline, frame by frame and seed by seed, over the frames that have the "
      "value in both; above zero is worse. For these trajectories: intervals are Student's t times the standard "
      "error of a paired bootstrap over blocks of at least {} successive frames and over noise seeds ({}), each "
      "wide enough for all {} together to err in {:g}% of comparisons of equal programs as far as blocks tell; "
      "what other seeds do is for the minimum effect ({}). They say nothing about other movements or hands. "
      "{}{}Better or worse: the interval excludes zero and the difference is at least the minimum effect. Same: "
      "the whole interval lies within the minimum effect, or all frames are equal. Worse in places: the interval "
      "cannot tell the rise from chance, since it lies in few blocks; but on these same frames it is twice the "
      "minimum effect or more (of a share, once). Not enough data: none of these.",
      config.block_frames, comparison.seeds, comparison.rows.size(), 100 * config.family_error,
      floor_sentence(comparison), noise, choice);
}

}  // namespace glovebench::reports
