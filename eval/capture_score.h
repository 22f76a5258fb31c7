#pragma once

#include <string>
#include <vector>

#include "eval/score.h"

namespace glovebench::eval {

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
