#pragma once

#include <string>
#include <vector>

#include "reports/comparison/settings_table.h"
#include "reports/study.h"

namespace glovebench::eval {

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
