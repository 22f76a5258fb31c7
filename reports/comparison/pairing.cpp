#include "reports/comparison/pairing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace glovebench::reports {
namespace {

void check_equal(const std::string& where, const std::string& field, const std::string& found,
                 const std::string& expected) {
  if (found != expected) throw Incomparable(where, field, found, expected);
}

/// Names the first difference; if one list is a part of the other, the lengths differ.
void check_names(const std::string& where, const std::string& field, const std::vector<std::string>& found,
                 const std::vector<std::string>& expected) {
  const size_t most = std::max(found.size(), expected.size());
  for (size_t i = 0; i < most; ++i)
    check_equal(where, fmt::format("{}[{}]", field, i), i < found.size() ? found[i] : "nothing",
                i < expected.size() ? expected[i] : "nothing");
}

void check_protocol(const std::string& where, const Protocol& found, const Protocol& expected) {
  check_equal(where, "protocol.metric_definitions", std::to_string(found.metric_definitions),
              std::to_string(expected.metric_definitions));
  check_names(where, "protocol.joint_order", found.joint_order, expected.joint_order);
  check_equal(where, "protocol.association", found.association, expected.association);
}

/// What must be equal for two experiments to be compared.
ExperimentKey paired_by(ExperimentKey key, const PairingOptions& options) {
  if (options.is_across(Across::noise)) key.noise = {};
  if (options.is_across(Across::subject)) key.subject = 1;
  return key;
}

void check_unique(const NamedResult& result, const PairingOptions& options) {
  std::map<std::string, std::string> names;
  for (const ExperimentResult& experiment : result.result.experiments) {
    const std::string name = to_string(experiment.key);
    const auto [other, is_new] = names.emplace(to_string(paired_by(experiment.key, options)), name);
    if (is_new) continue;
    if (other->second == name) throw Incomparable(result.name, "experiments", name + " twice", "each of them once");
    throw Incomparable(result.name, "experiments", fmt::format("{} and {}", other->second, name),
                       "one of them, since they differ only in what is compared across");
  }
}

constexpr std::string_view kAcrossHint = " (they differ in {}: `glovebench compare --across {}`)";

/// A missing hash cannot be compared.
void check_hash(const NamedResult& baseline, const NamedResult& candidate, const std::string& name,
                std::map<std::string, std::string> InputHashes::*hashes, const std::string& field,
                const std::string& hint = "") {
  const auto& found = candidate.result.inputs.*hashes;
  const auto& expected = baseline.result.inputs.*hashes;
  if (!expected.contains(name)) throw Incomparable(baseline.name, field + name, "nothing", "a hash");
  if (!found.contains(name)) throw Incomparable(candidate.name, field + name, "nothing", expected.at(name));
  if (found.at(name) != expected.at(name))
    throw Incomparable(candidate.name, field + name, found.at(name), expected.at(name) + hint);
}

void check_inputs(const NamedResult& baseline, const NamedResult& candidate, const ExperimentKey& key,
                  const PairingOptions& options) {
  check_hash(baseline, candidate, truth_name(key), &InputHashes::truths, "inputs.truths.");
  const bool other_hand = baseline.result.inputs.hand_model != candidate.result.inputs.hand_model;
  if (other_hand && options.is_across(Across::hand)) return;
  check_hash(baseline, candidate, key.database, &InputHashes::databases, "inputs.databases.",
             other_hand ? fmt::format(kAcrossHint, "hand", "hand") : "");
}

std::string seeds_of(const ExperimentResult& experiment) {
  std::vector<uint64_t> seeds;
  for (const SeedRun& run : experiment.runs) seeds.push_back(run.seed);
  return fmt::format("[{}]", fmt::join(seeds, ", "));
}

void check_seeds(const std::string& where, const ExperimentResult& found, const ExperimentResult& expected,
                 bool other_seeds) {
  const std::string field = to_string(expected.key) + ".seeds";
  if (!other_seeds) check_equal(where, field, seeds_of(found), seeds_of(expected));
  if (found.runs.size() != expected.runs.size())
    throw Incomparable(where, field, seeds_of(found), counted(expected.runs.size(), "seed"));
}

/// Index in the longer list where the shorter one stops following it.
size_t first_extra(const std::vector<FrameRecord>& longer, const std::vector<FrameRecord>& shorter) {
  size_t i = 0;
  while (i < shorter.size() && shorter[i].frame == longer[i].frame) ++i;
  return i;
}

void check_frames(const std::string& where, const std::string& field, const std::vector<FrameRecord>& found,
                  const std::vector<FrameRecord>& expected) {
  if (found.size() < expected.size())
    throw Incomparable(
        where, field,
        fmt::format("{} frames, without frame {}", found.size(), expected[first_extra(expected, found)].frame),
        fmt::format("{} frames (a lost frame stays in a result)", expected.size()));
  if (found.size() > expected.size())
    throw Incomparable(
        where, field,
        fmt::format("{} frames, frame {} among them", found.size(), found[first_extra(found, expected)].frame),
        fmt::format("{} frames without it", expected.size()));
  for (size_t i = 0; i < found.size(); ++i) {
    const std::string frame = fmt::format("{}[{}].", field, i);
    check_equal(where, frame + "frame", std::to_string(found[i].frame), std::to_string(expected[i].frame));
    check_equal(where, frame + "timestamp_us", std::to_string(found[i].timestamp_us),
                std::to_string(expected[i].timestamp_us));
  }
}

void check_runs(const std::string& where, const ExperimentResult& found, const ExperimentResult& expected) {
  for (size_t s = 0; s < expected.runs.size(); ++s)
    check_frames(where, fmt::format("{}.seed {}.frames", to_string(expected.key), found.runs[s].seed),
                 found.runs[s].frames, expected.runs[s].frames);
}

/// Null if there is none.
const ExperimentResult* find_partner(const RunResult& result, const ExperimentKey& key,
                                     const PairingOptions& options) {
  if (options.across.empty()) return find_experiment(result, key);
  const auto found = std::ranges::find_if(result.experiments, [&](const ExperimentResult& experiment) {
    return paired_by(experiment.key, options) == paired_by(key, options);
  });
  return found == result.experiments.end() ? nullptr : &*found;
}

/// How the baseline's experiment could be compared if the candidate has it with a noise or subject of its own; else
/// empty.
std::string across_hint(const ExperimentKey& missing, const RunResult& baseline, const RunResult& candidate) {
  const ExperimentResult* other = find_partner(candidate, missing, {.across = {Across::noise, Across::subject}});
  if (other && find_experiment(baseline, other->key)) return "";  // has a partner of its own
  std::vector<std::string_view> differing;
  if (other && other->key.noise != missing.noise) differing.push_back(to_string(Across::noise));
  if (other && other->key.subject != missing.subject) differing.push_back(to_string(Across::subject));
  if (differing.empty()) return "";
  return fmt::format(kAcrossHint, fmt::join(differing, " and "), fmt::join(differing, ","));
}

/// The first of the baseline that the candidate lacks.
[[noreturn]] void refuse_missing(const NamedResult& baseline, const NamedResult& candidate,
                                 const Pairing& pairing) {
  const std::vector<ExperimentResult>& all = baseline.result.experiments;
  const std::string& name = pairing.only_in_baseline.front();
  const auto missing =
      std::ranges::find(all, name, [](const ExperimentResult& experiment) { return to_string(experiment.key); });
  throw Incomparable(
      candidate.name, "experiments", "no " + name,
      (all.size() == 1 ? "it, as in the baseline" : fmt::format("all {} of the baseline's", all.size())) +
          across_hint(missing->key, baseline.result, candidate.result));
}

Pairing pair_experiments(const RunResult& baseline, const RunResult& candidate, const PairingOptions& options) {
  Pairing pairing;
  for (const ExperimentResult& experiment : baseline.experiments)
    if (const ExperimentResult* other = find_partner(candidate, experiment.key, options))
      pairing.experiments.emplace_back(&experiment, other);
    else
      pairing.only_in_baseline.push_back(to_string(experiment.key));
  for (const ExperimentResult& experiment : candidate.experiments)
    if (!find_partner(baseline, experiment.key, options))
      pairing.only_in_candidate.push_back(to_string(experiment.key));
  return pairing;
}

/// The frames of both, by number and time stamp, which rise in each.
void keep_shared(std::vector<FrameRecord>& one, std::vector<FrameRecord>& other) {
  std::vector<FrameRecord> ones, others;
  for (size_t i = 0, j = 0; i < one.size() && j < other.size();) {
    if (one[i].frame != other[j].frame) {
      one[i].frame < other[j].frame ? ++i : ++j;
      continue;
    }
    if (one[i].timestamp_us == other[j].timestamp_us) {
      ones.push_back(one[i]);
      others.push_back(other[j]);
    }
    ++i;
    ++j;
  }
  one = std::move(ones);
  other = std::move(others);
}

/// Both need equal numbers of runs.
void cut_to_shared_frames(Pairing& pairing, const std::string& candidate_name) {
  for (auto& [expected, found] : pairing.experiments) {
    const auto before = std::make_shared<ExperimentResult>(*expected);
    const auto after = std::make_shared<ExperimentResult>(*found);
    for (size_t s = 0; s < before->runs.size(); ++s) {
      keep_shared(before->runs[s].frames, after->runs[s].frames);
      if (before->runs[s].frames.empty())
        throw Incomparable(candidate_name, to_string(found->key) + ".frames", "none that the baseline has",
                           "at least one");
    }
    pairing.cut.insert(pairing.cut.end(), {before, after});
    expected = before.get();
    found = after.get();
  }
}

std::string frames_text(const ExperimentResult& experiment) {
  if (experiment.runs.empty() || experiment.runs.front().frames.empty()) return "none";
  const std::vector<FrameRecord>& frames = experiment.runs.front().frames;
  return fmt::format("{} to {}", frames.front().frame, frames.back().frame);
}

/// The differences between the runs and between their experiments. None is listed twice.
std::vector<ConfigurationChange> across_changes(const RunResult& baseline, const RunResult& candidate,
                                                const Pairing& pairing) {
  std::vector<ConfigurationChange> changes;
  const auto add = [&](const char* field, const std::string& before, const std::string& after) {
    const bool is_known = std::ranges::any_of(changes, [&](const ConfigurationChange& known) {
      return known.field == field && known.baseline == before && known.candidate == after;
    });
    if (before != after && !is_known) changes.push_back({field, before, after});
  };
  add("inputs.hand_model", baseline.inputs.hand_model, candidate.inputs.hand_model);
  const auto noise = [](const ExperimentKey& key) {
    return fmt::format("{} x {}", key.noise.model, key.noise.factor);
  };
  for (const auto& [before, after] : pairing.experiments) {
    add("noise", noise(before->key), noise(after->key));
    add("subject", std::to_string(before->key.subject), std::to_string(after->key.subject));
    add("frames", frames_text(*before), frames_text(*after));
  }
  return changes;
}

bool has(const Protocol& protocol, const Metric& metric) {
  const std::string_view column = metric.is_share() ? metric.of_column : metric.key;
  return column.empty() || std::ranges::find(protocol.metric_keys, column) != protocol.metric_keys.end();
}

}  // namespace

std::vector<const Metric*> shared_metrics(const Protocol& baseline, const Protocol& candidate) {
  std::vector<const Metric*> shared;
  for (const Metric& metric : gated_metrics())
    if (has(baseline, metric) && has(candidate, metric)) shared.push_back(&metric);
  return shared;
}

std::map<std::string, std::string> uncompared_metrics(const Protocol& baseline, const Protocol& candidate) {
  std::map<std::string, std::string> why;
  for (const Metric& metric : gated_metrics()) {
    if (!has(baseline, metric)) why[std::string(metric.key)] = "not in the baseline";
    if (!has(candidate, metric)) why[std::string(metric.key)] = "not in the candidate";
  }
  for (const Protocol* protocol : {&baseline, &candidate})
    for (const std::string& key : protocol->metric_keys)
      if (!find_frame_metric(key)) why[key] = "unknown to this program";
  return why;
}

Pairing pair_results(const NamedResult& baseline, const NamedResult& candidate, const PairingOptions& options) {
  check_protocol(candidate.name, candidate.result.protocol, baseline.result.protocol);
  check_unique(baseline, options);
  check_unique(candidate, options);
  Pairing pairing = pair_experiments(baseline.result, candidate.result, options);
  for (const Metric* metric : shared_metrics(baseline.result.protocol, candidate.result.protocol))
    if (options.metrics.empty() || std::ranges::count(options.metrics, metric->key) > 0)
      pairing.metrics.push_back(metric);
  if (pairing.metrics.empty()) throw Incomparable(candidate.name, "metrics", "none to compare", "at least one");
  for (const auto& [expected, found] : pairing.experiments)
    check_inputs(baseline, candidate, expected->key, options);
  for (const auto& [expected, found] : pairing.experiments)
    check_seeds(candidate.name, *found, *expected, options.other_seeds);
  pairing.across = across_changes(baseline.result, candidate.result, pairing);
  if (options.is_across(Across::frames)) cut_to_shared_frames(pairing, candidate.name);
  for (const auto& [expected, found] : pairing.experiments) check_runs(candidate.name, *found, *expected);
  if (!options.partial && !pairing.only_in_baseline.empty()) refuse_missing(baseline, candidate, pairing);
  if (pairing.experiments.empty())
    throw Incomparable(candidate.name, "experiments", "none that the baseline has", "at least one");
  return pairing;
}

}  // namespace glovebench::reports
