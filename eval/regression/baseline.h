#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/file_set.h"
#include "eval/suite.h"
#include "reports/comparison/noise_floor.h"
#include "reports/comparison/pairing.h"
#include "reports/comparison/speed.h"
#include "reports/comparison/stage_times.h"

namespace glovebench::eval {

struct FinishedRun {
  FileSet files;
  reports::NamedResult results;
};
/// Throws: Error, or Incomparable for an unfinished run.
FinishedRun load_finished_run(const std::string& folder_or_file);
std::optional<reports::NoiseFloor> load_noise_floor_beside(const FileSet& files);
/// Empty without times.
reports::StageTimes load_stage_times(const FileSet& files);

/// Files: ci/README.md, "Baselines". Noise floor and speed are optional.
struct Baseline {
  FinishedRun run;
  std::optional<reports::NoiseFloor> noise_floor;
  std::vector<reports::SpeedRatio> speed;
  reports::StageTimes times;
};
/// Throws: Error, or Incomparable without a baseline or with edited results.
Baseline load_baseline(const std::string& folder);

/// The part of provenance.json that is read.
struct Provenance {
  std::string results_hash;
  reports::StageTimes times;
};
/// Throws: Error.
Provenance parse_provenance(const std::string& text, const std::string& where);

/// "ci/baselines/quick".
std::string default_baseline_folder(const std::string& suite);

/// The suite of this name or file, else the run's.
/// Throws: Error if the run has none or another.
Suite suite_of(const reports::NamedResult& run, const std::string& name_or_file);

/// Makes a run the baseline; keeps the noise floor. `suite`: empty for a score. `accepted`: failures that the user
/// accepted.
/// Throws: Error if a suite's run is not whole, the folder holds a run, or a truth differs from the old
/// baseline's.
void update_baseline(const std::string& folder, const reports::NamedResult& run, const std::optional<Suite>& suite,
                     const std::vector<reports::SpeedRatio>& speed, const reports::StageTimes& times,
                     const std::vector<std::string>& accepted);

}  // namespace glovebench::eval
