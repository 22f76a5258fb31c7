#pragma once

#include <string>
#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

struct WorstFrame {
  ExperimentKey key;
  uint64_t seed = 0;
  FrameRecord frame;
  std::string metric;  ///< by which it was chosen
};

/// Half of `count` by position error, half by posture error (RMS), from subject 1 on source truth under the
/// headline noise, or else all experiments. At most two per experiment, 0.5 s apart in one run, none twice, none
/// lost.
std::vector<WorstFrame> worst_frames(const RunResult& result, int count = 8);

/// Shows every stage of the frame of the run in `folder`.
std::string explain_command(const WorstFrame& worst, const std::string& folder = ".");
/// Experiment, frame, errors.
std::string caption(const WorstFrame& worst);

}  // namespace glovebench::reports
