#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/json_cursor.h"

namespace glovebench::reports {

struct StageTimes {
  std::string processor;
  int threads = 0;
  struct Stage {
    std::string name;
    double median_ms = 0;  ///< mean of experiments' medians
  };
  std::vector<Stage> stages;
};

/// Reads timings.json.
/// Throws: Error.
StageTimes read_stage_times(const std::string& timings_path);
StageTimes parse_stage_times(const std::string& text, const std::string& where);

nlohmann::ordered_json stage_times_json(const StageTimes& times);
StageTimes stage_times_from(const JsonCursor& json);

/// Only for stages of both runs.
struct StageTimeChange {
  std::string stage;
  double baseline_ms = 0;
  double candidate_ms = 0;
};
struct StageTimeChanges {
  bool same_machine = false;  ///< same processor and threads
  std::vector<StageTimeChange> stages;
};
StageTimeChanges compare_stage_times(const StageTimes& baseline, const StageTimes& candidate);

}  // namespace glovebench::reports
