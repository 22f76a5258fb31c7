#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

/// Times of one stage over the frames of an experiment.
struct StageTiming {
  std::string stage;
  std::vector<double> frame_ms;  ///< one value a frame
};

struct ExperimentTiming {
  ExperimentKey key;
  double wall_s = 0;
  std::vector<StageTiming> stages;
  std::vector<double> command_ms = {};  ///< from a device frame to its robot command, one value a frame
};

/// What differs from run to run, and so stands apart from the results.
struct Timings {
  std::string host;
  std::string processor;
  int threads = 1;
  std::string compiler;
  std::string build_type;
  std::string commit;
  std::string date;  ///< ISO 8601, UTC
  double wall_s = 0;
  /// Of the process; its experiments run side by side and share the databases, so none has a peak of its own. Empty
  /// where it cannot be told.
  std::optional<double> peak_memory_mb;
  std::vector<ExperimentTiming> experiments;
};

/// timings.json: of each stage count, mean, median, 95th percentile and maximum; of the robot
/// commands the 99th as well; of the studies what is a time.
std::string timings_json(const Timings& timings, const std::vector<StudyResult>& studies = {});

}  // namespace glovebench::reports
