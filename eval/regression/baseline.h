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

/// A finished run or a baseline, whose folder was opened once: all that is read through `files` is of one state.
struct StoredRun {
  FileSet files;
  reports::NamedResult results;
};
/// Its folder, or the results.json itself. Throws Error, or Incomparable if the run is unfinished.
StoredRun load_run(const std::string& folder_or_file);
/// The noise floor beside results, if there is one.
std::optional<reports::NoiseFloor> load_noise_floor_beside(const FileSet& files);
/// How long the stages of a run took; empty where its folder does not say.
reports::StageTimes load_stage_times(const FileSet& files);

/// What changes are gated against, as it stands in a folder that is committed:
///   results.json      of the run that became the baseline
///   noise_floor.json  what other seeds do (glovebench calibrate noise); may be missing
///   speed.json        ratios to the plain implementations; may be missing
///   provenance.json   what made it: commit, date, compiler, processor with the times of the tracker's stages; and
///                     what it replaced
///   manifest.json     names and hashes of results, speed and provenance, which are one set (core/base/file_set.h);
///                     an older baseline has none
struct Baseline {
  StoredRun run;
  std::optional<reports::NoiseFloor> noise_floor;
  std::vector<reports::SpeedRatio> speed;
  reports::StageTimes times;
};
/// Throws Incomparable if there is no baseline.
Baseline load_baseline(const std::string& folder);

/// What is read back of what a baseline was made by.
struct Provenance {
  std::string results_hash;  ///< of its results.json
  reports::StageTimes times;
};
/// Throws Error(where, field, found, expected).
Provenance parse_provenance(const std::string& text, const std::string& where);

/// "ci/baselines/quick", below the current folder.
std::string default_baseline_folder(const std::string& suite);

/// The suite of a run: the given one (a name or file) or, if that is empty, the program's own of that name. Throws
/// Error if the run is of none, or of another.
Suite suite_of(const reports::NamedResult& run, const std::string& name_or_file);

/// Makes a run the baseline; the noise floor stays as it is. Writes into the folder alone. Throws Error if the run
/// is not the whole suite, the folder holds a run, or a truth is another than that of the baseline that it would
/// replace: whoever means that deletes the old one.
void update_baseline(const std::string& folder, const reports::NamedResult& run, const Suite& suite,
                     const std::vector<reports::SpeedRatio>& speed, const reports::StageTimes& times);

}  // namespace glovebench::eval
