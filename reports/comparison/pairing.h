#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

/// A result and what it is called in messages: its file or folder.
struct NamedResult {
  std::string name;
  RunResult result;
};

struct PairingOptions {
  /// The candidate was run with other noise seeds, as many: they are paired in their order. Otherwise the seeds
  /// must be the same.
  bool other_seeds = false;
  /// Compare the experiments that both have. Otherwise the candidate must have all of the baseline's.
  bool partial = false;
};

/// What both results have. Experiments are of the same frames: run i of one belongs to run i of the other, frame j
/// to frame j. The pointers refer to the results.
struct Pairing {
  std::vector<const Metric*> metrics;  ///< gated ones, in their order
  std::vector<std::pair<const ExperimentResult*, const ExperimentResult*>> experiments;  ///< baseline, candidate
  std::vector<std::string> only_in_baseline;                                             ///< names of experiments
  std::vector<std::string> only_in_candidate;
};

/// The gated metrics that both results have, and why others are not compared: one lacks them, or the program does
/// not know them.
std::vector<const Metric*> shared_metrics(const Protocol& baseline, const Protocol& candidate);
std::map<std::string, std::string> uncompared_metrics(const Protocol& baseline, const Protocol& candidate);

/// Throws Incomparable naming the first field that differs: a member of the protocol but its metrics, the hash of a
/// shared truth or database (also if a file does not say it), an experiment that is there twice, seeds, frame
/// numbers and time stamps (a frame that left the result, lost or not, is one that differs), or an experiment that
/// the candidate lacks; also if there is nothing to compare.
Pairing pair_results(const NamedResult& baseline, const NamedResult& candidate, const PairingOptions& options = {});

}  // namespace glovebench::reports
