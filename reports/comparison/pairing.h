#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

/// `name`: file or folder.
struct NamedResult {
  std::string name;
  RunResult result;
};

/// How compared experiments may differ.
enum class Across { noise, subject, frames, hand };
constexpr auto names_of(Across) { return std::to_array<std::string_view>({"noise", "subject", "frames", "hand"}); }

struct PairingOptions {
  /// Pairs noise seeds in order; counts must be equal. Otherwise seeds must be equal.
  bool other_seeds = false;
  /// Compares shared experiments. Otherwise the candidate needs all of the baseline's.
  bool partial = false;
  /// Otherwise noise, subject, frames and database must be equal. Across frames, compares shared frames. Across
  /// hand, the tracker's hands may differ, and the databases that are built from them.
  std::vector<Across> across = {};
  std::vector<std::string> metrics = {};  ///< gated, chosen beforehand; empty: all

  bool is_across(Across what) const { return std::ranges::find(across, what) != across.end(); }
};

/// A difference in the configuration, or in Across.
struct ConfigurationChange {
  std::string field;     ///< "icp.max_iterations"
  std::string baseline;  ///< JSON; empty if absent
  std::string candidate;
};

/// Run i and frame j of both results belong together. Points into the results.
struct Pairing {
  std::vector<const Metric*> metrics;                                                    ///< gated
  std::vector<std::pair<const ExperimentResult*, const ExperimentResult*>> experiments;  ///< baseline, candidate
  std::vector<std::string> only_in_baseline;                                             ///< experiments
  std::vector<std::string> only_in_candidate;
  std::vector<ConfigurationChange> across = {};
  std::vector<std::shared_ptr<const ExperimentResult>> cut = {};  ///< with only the shared frames
};

/// Gated metrics of both results.
std::vector<const Metric*> shared_metrics(const Protocol& baseline, const Protocol& candidate);
/// Other metrics, with reasons.
std::map<std::string, std::string> uncompared_metrics(const Protocol& baseline, const Protocol& candidate);

/// Throws: Incomparable with the first difference: protocol (except metrics), hash of a shared truth or database
/// (also if missing), repeated or missing experiment, seeds, frame numbers, time stamps; or if nothing is left.
/// Across noise or subject, also if two experiments of one result differ in nothing else.
Pairing pair_results(const NamedResult& baseline, const NamedResult& candidate, const PairingOptions& options = {});

}  // namespace glovebench::reports
