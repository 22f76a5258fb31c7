#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/json_cursor.h"

namespace glovebench::reports {

/// How long the stages of the tracker took in a run: for information, since it says as much about the machine, and
/// what else it did, as about the program.
struct StageTimes {
  std::string processor;
  int threads = 0;
  struct Stage {
    std::string name;
    double median_ms = 0;  ///< mean over the experiments of their medians
  };
  std::vector<Stage> stages;
};

/// From a run's timings.json. Throws Error.
StageTimes read_stage_times(const std::string& timings_path);
/// The same for the file's text; `where` names it in errors.
StageTimes parse_stage_times(const std::string& text, const std::string& where);

/// As part of another file (a baseline's provenance).
nlohmann::ordered_json stage_times_json(const StageTimes& times);
StageTimes stage_times_from(const JsonCursor& json);

/// One stage in two runs; a stage that one of them does not have is left out.
struct StageTimeChange {
  std::string stage;
  double baseline_ms = 0;
  double candidate_ms = 0;
};
struct StageTimeChanges {
  bool same_machine = false;  ///< the same processor and number of threads
  std::vector<StageTimeChange> stages;
};
StageTimeChanges compare_stage_times(const StageTimes& baseline, const StageTimes& candidate);

}  // namespace glovebench::reports
