#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

/// `name`, used in messages: file or folder.
struct NamedResult {
  std::string name;
  RunResult result;
};

struct PairingOptions {
  /// Pairs different noise seeds, equal in number, in their order. Otherwise seeds must be equal.
  bool other_seeds = false;
  /// Compares shared experiments. Otherwise the candidate needs all of the baseline's.
  bool partial = false;
};

/// Run i and frame j of both results belong together. Points into the results.
struct Pairing {
  std::vector<const Metric*> metrics;                                                    ///< gated
  std::vector<std::pair<const ExperimentResult*, const ExperimentResult*>> experiments;  ///< baseline, candidate
  std::vector<std::string> only_in_baseline;                                             ///< names of experiments
  std::vector<std::string> only_in_candidate;
};

/// Gated metrics of both results, and why others are not compared.
std::vector<const Metric*> shared_metrics(const Protocol& baseline, const Protocol& candidate);
std::map<std::string, std::string> uncompared_metrics(const Protocol& baseline, const Protocol& candidate);

/// Throws: Incomparable naming the first difference: protocol (except metrics), hash of a shared truth or database
/// (also if missing), repeated or missing experiment, seeds, frame numbers, time stamps; or if nothing is left.
Pairing pair_results(const NamedResult& baseline, const NamedResult& candidate, const PairingOptions& options = {});

}  // namespace glovebench::reports
