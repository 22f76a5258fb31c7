#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/estimates/estimate_format.h"
#include "eval/plan.h"
#include "eval/run.h"

namespace glovebench::eval {

struct ScoreRequest {
  RunSpec spec;           ///< without a tracker; its database is the name of the estimates
  std::string estimates;  ///< file
  std::string format;     ///< empty: by ending and first line
  std::string beside;     ///< file with angles or joints of the same poses; empty: none
  EstimateFlags flags;
  std::optional<double> tolerance_ms;  ///< empty: half the time between frames
  double offset_ms = 0;                ///< added to the estimates' times
  bool estimates_offset = false;       ///< estimates the offset instead
};

/// Runs whose answers come from a file.
struct Score {
  Plan plan;
  std::vector<Run> runs;             ///< one per seed of the file
  std::vector<std::string> matches;  ///< sentences on times
};
/// Throws: Error.
Score score(Workbench& workbench, const ScoreRequest& request);

/// Estimates of a recording, and a capture of the same hand by another system with a clock and a frame of its own.
struct CaptureRequest {
  RunSpec spec;  ///< its trajectory: the capture, in the capture's frame; its database: the name of the estimates
  std::vector<TrackResult> answers;
  std::string recording;  ///< name, for messages
};

/// Aligns the capture with the recording. The truth is the capture at the times of the answers, in the camera's
/// frame.
/// Throws: Error as `align_to_capture`.
Score score_against_capture(Workbench& workbench, const CaptureRequest& request);

}  // namespace glovebench::eval
