#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/comparison/comparison.h"
#include "reports/table.h"

namespace glovebench::reports {

struct SettingRun {
  NamedResult run;                ///< its name is the row's
  std::optional<double> time_ms;  ///< of a frame, measured while no other job ran; empty: unknown
};

/// Runs of the same frames, each compared with the reference.
struct SettingsTable {
  std::string reference;
  bool is_paper = false;                    ///< reference has the paper's configuration
  std::string experiments;                  ///< whose frames are compared
  std::map<std::string, std::string> runs;  ///< `run_name` by setting
  CompareConfig config;                     ///< of all comparisons together
  std::vector<std::string> preselected;     ///< metrics chosen before; empty: all
  Table table;                              ///< quantity, setting, mean, difference with its interval, verdict
  Table changes;                            ///< fields that differ from the reference
  std::vector<std::string> enough;          ///< one line per undecided row: how much data would decide
  std::string recommendation;
  std::string explanation;
};

/// The default metrics of a table.
std::vector<std::string> headline_metrics();

/// Compares each run with the one that has the paper's configuration, else with the first. All intervals of the
/// table hold together (CompareConfig::family_error).
/// Throws: Error for fewer than two runs or a repeated name; Incomparable.
SettingsTable compare_settings(const std::vector<SettingRun>& runs, const PairingOptions& pairing,
                               const CompareConfig& config = {});

std::string settings_text(const SettingsTable& settings, size_t columns);
std::string settings_markdown(const SettingsTable& settings);
std::string settings_html(const SettingsTable& settings);
/// CSV and LaTeX name experiments, runs, confidence and chosen metrics.
std::string settings_csv(const SettingsTable& settings);
std::string settings_latex(const SettingsTable& settings);

}  // namespace glovebench::reports
