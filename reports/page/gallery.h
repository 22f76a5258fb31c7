#pragma once

#include <string>
#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

struct WorstFrame {
  ExperimentKey key;
  uint64_t seed = 0;
  FrameRecord frame;
  std::string metric;  ///< that chose it
};

/// Half of `count` by position error, half by posture error (RMS), from subject 1 on source truth under the
/// headline noise, else from all experiments. At most two an experiment, 0.5 s apart in a run, none twice, none
/// lost.
std::vector<WorstFrame> worst_frames(const RunResult& result, int count = 8);

/// Shows the frame's stages, from the run's folder.
std::string explain_command(const WorstFrame& worst);
/// Experiment, frame, errors.
std::string caption(const WorstFrame& worst);

}  // namespace glovebench::reports
