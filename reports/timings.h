#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

struct StageTiming {
  std::string stage;
  std::vector<double> frame_ms;
};

struct ExperimentTiming {
  ExperimentKey key;
  double wall_s = 0;
  std::vector<StageTiming> stages;
  std::vector<double> command_ms = {};  ///< device frame to robot command, by frame
};

/// Values that differ between equal runs.
struct Timings {
  std::string host;
  std::string processor;
  int threads = 1;
  std::string compiler;
  std::string build_type;
  std::string commit;
  std::string date;  ///< ISO 8601, UTC
  double wall_s = 0;
  /// Of the whole process.
  std::optional<double> peak_memory_mb;
  std::vector<ExperimentTiming> experiments;
};

/// Statistics of stages, p99 of robot commands, times of studies.
std::string timings_json(const Timings& timings, const std::vector<StudyResult>& studies = {});

}  // namespace glovebench::reports
