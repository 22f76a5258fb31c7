#pragma once

#include <span>
#include <string>
#include <vector>

#include "eval/measured_run.h"
#include "eval/plan.h"
#include "reports/comparison/settings_table.h"
#include "reports/study.h"

namespace glovebench::eval {

Plan with_tracker(Plan plan, const TrackerConfig& tracker);

/// Runs the plan with each tracker, on images rendered once. Returns a list per tracker, in the plan's order.
/// Stage times come from a second pass over the first frames of each experiment's first seed, one job at a time,
/// trackers in turn for each frame.
/// Throws: as `execute`.
std::vector<std::vector<MeasuredRun>> run_settings(Workbench& workbench, const Plan& plan,
                                                   std::span<const TrackerConfig> trackers,
                                                   const RunOptions& options);

/// Names runs after their folders. Shows the headline metrics unless `pairing` has others, and times only if
/// measured one job at a time.
/// Throws: Error, or Incomparable, also for an unfinished run.
reports::SettingsTable settings_table(const std::vector<std::string>& folders, reports::PairingOptions pairing = {},
                                      const reports::CompareConfig& config = {});

/// Writes table.md, .csv, .tex and index.html; STUDY.md and TABLE.csv of `studies`.
/// Throws: Error, also if the folder holds a run.
void write_settings_table(const std::string& folder, const reports::SettingsTable& table,
                          const std::vector<reports::StudyResult>& studies = {});

}  // namespace glovebench::eval
