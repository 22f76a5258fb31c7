#pragma once

#include <string>
#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

/// A frame with a large error.
struct WorstFrame {
  ExperimentKey key;
  uint64_t seed = 0;
  FrameRecord frame;
  std::string metric;  ///< the one by which it was chosen
};

/// The worst frames of a run: half of `count` by position error, half by posture error (RMS). They are of the first
/// subject on source truth under the headline noise, or of all experiments if there are none of those. No
/// experiment has more than two, no frame comes twice, and frames of one replay are at least half a second apart,
/// since neighbors look alike. Lost frames have no error and are not among them.
std::vector<WorstFrame> worst_frames(const RunResult& result, int count = 8);

/// What a user types in the run's folder to see every stage of the frame.
std::string explain_command(const WorstFrame& worst);
/// Experiment, frame, and its errors.
std::string caption(const WorstFrame& worst);

}  // namespace glovebench::reports
