#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/comparison/comparison.h"
#include "reports/table.h"

namespace glovebench::reports {

struct SettingRun {
  NamedResult run;                ///< the row has its name
  std::optional<double> time_ms;  ///< per frame, measured without other jobs
};

/// Runs of the same frames, each compared with the reference.
struct SettingsTable {
  std::string reference;
  bool is_paper = false;                    ///< has the paper's configuration
  bool has_times = false;                   ///< some run was timed alone
  std::string experiments;                  ///< names of those compared
  std::map<std::string, std::string> runs;  ///< `run_name` by setting
  CompareConfig config;                     ///< of all comparisons together
  std::vector<std::string> preselected;     ///< metrics; empty: all
  Table table;                              ///< quantity, setting, mean, difference with interval, verdict
  Table changes;                            ///< fields that differ from the reference
  std::vector<std::string> enough;          ///< per undecided row: data that would decide
  std::string recommendation;
  std::string explanation;
};

std::vector<std::string> headline_metrics();

/// Compares each run with the one of the paper's configuration, else with the first.
/// Throws: Error for fewer than two runs or a repeated name; Incomparable.
SettingsTable compare_settings(const std::vector<SettingRun>& runs, const PairingOptions& pairing,
                               const CompareConfig& config = {});

std::string settings_text(const SettingsTable& settings, size_t columns);
std::string settings_markdown(const SettingsTable& settings);
/// `scripts`: as in PageMaterial.
std::string settings_html(const SettingsTable& settings, const std::vector<std::string>& scripts = {});
std::string settings_csv(const SettingsTable& settings);
std::string settings_latex(const SettingsTable& settings);

}  // namespace glovebench::reports
