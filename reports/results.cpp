#include "reports/results.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/hash.h"
#include "core/hand/posture.h"
#include "reports/metrics/coverage.h"

namespace glovebench::reports {

std::string to_string(const ExperimentKey& key) {
  const bool has_glove = key.appearance == Appearance::glove;
  return fmt::format("{}_{}_{}_subject{}{}_{}_{}", key.trajectory, key.database, to_string(key.truth), key.subject,
                     has_glove ? "" : fmt::format("-{}", to_string(key.appearance)), key.noise.model,
                     key.noise.factor);
}

namespace {

std::optional<double> part_of(std::optional<int> part, int whole) {
  if (whole == 0 || !part) return std::nullopt;
  return static_cast<double>(*part) / whole;
}

/// Counts one that is true. One unknown makes the count unknown.
void count(std::optional<int>& counted, std::optional<bool> is_true) {
  if (!is_true) counted.reset();
  if (counted) *counted += *is_true;
}

}  // namespace

std::optional<double> Coverage::share() const { return part_of(covered, frames); }

std::optional<double> Coverage::found_share() const { return part_of(found, visible); }

std::optional<double> Coverage::usable_share() const { return part_of(usable, visible); }

Coverage count_coverage(const std::vector<SeedRun>& runs) {
  Coverage coverage;
  for (const SeedRun& run : runs) {
    for (const FrameRecord& frame : run.frames) {
      ++coverage.frames;
      const auto judged = [&](bool is_true) { return frame.is_judged ? std::optional(is_true) : std::nullopt; };
      count(coverage.covered, judged(frame.covered));
      coverage.lost += frame.status != TrackStatus::tracked;
      count(coverage.false_tracked, judged(frame.false_tracked));
      coverage.false_lost += frame.false_lost;
      if (!is_visible(frame)) continue;
      ++coverage.visible;
      count(coverage.found, judged(frame.covered));
      count(coverage.usable, is_usable(frame));
    }
  }
  return coverage;
}

ExperimentResult summarize(ExperimentKey key, std::vector<SeedRun> runs, PckCurve pck, SequenceMetrics sequence,
                           const BootstrapConfig& bootstrap) {
  ExperimentResult result;
  result.key = std::move(key);
  result.runs = std::move(runs);
  result.pck = std::move(pck);
  result.sequence = sequence;
  result.coverage = count_coverage(result.runs);
  for (size_t m = 0; m < frame_metrics().size(); ++m) {
    std::vector<double> values;
    std::vector<std::vector<std::optional<double>>> by_seed;
    for (const SeedRun& run : result.runs) {
      by_seed.emplace_back();
      for (const FrameRecord& frame : run.frames) {
        const std::optional<double>& value = frame.values[m];
        by_seed.back().push_back(value);
        if (value) values.push_back(*value);
      }
    }
    result.aggregates[m] = aggregate(values);
    result.intervals[m] = confidence_interval(by_seed, bootstrap);
  }
  return result;
}

std::string Protocol::id() const {
  nlohmann::json content = {metric_definitions, joint_order, metric_keys, association};
  if (!coverage_rules.empty()) content.push_back(coverage_rules);  // older ids stay
  return hash_text(content.dump());
}

Protocol make_protocol(std::string association) {
  Protocol protocol;
  for (const AngleInfo& info : angle_infos()) protocol.joint_order.emplace_back(info.name);
  protocol.metric_keys = frame_metric_keys();
  protocol.association = std::move(association);
  protocol.coverage_rules = coverage_rules();
  return protocol;
}

std::string truth_name(const ExperimentKey& key) {
  return fmt::format("{}/{}", to_string(key.truth), key.trajectory);
}

std::string run_name(const RunResult& result) {
  constexpr size_t kDigits = 8;
  nlohmann::json experiments = nlohmann::json::array();
  for (const ExperimentResult& experiment : result.experiments) {
    nlohmann::json seeds = nlohmann::json::array();
    for (const SeedRun& run : experiment.runs) seeds.push_back({run.seed, run.frames.size()});
    experiments.push_back({to_string(experiment.key), seeds});
  }
  const InputHashes& inputs = result.inputs;
  const nlohmann::json content = {
      result.protocol.id(), result.program_version, result.commit,     result.suite,       result.configuration,
      inputs.truths,        inputs.databases,       inputs.hand_model, inputs.color_table, experiments};
  const std::string text = content.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return result.commit + "-" + hash_text(text).substr(0, kDigits);
}

NoiseSetting headline_noise(const RunResult& result) {
  const NoiseSetting paper;
  const bool has_paper =
      std::ranges::any_of(result.experiments, [&](const auto& e) { return e.key.noise == paper; });
  return has_paper || result.experiments.empty() ? paper : result.experiments.front().key.noise;
}

const ExperimentResult* find_experiment(const RunResult& result, const ExperimentKey& key) {
  const auto found = std::ranges::find(result.experiments, key, &ExperimentResult::key);
  return found == result.experiments.end() ? nullptr : &*found;
}

}  // namespace glovebench::reports
