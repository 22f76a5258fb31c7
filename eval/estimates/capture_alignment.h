#pragma once

#include <span>
#include <string>
#include <vector>

#include "eval/estimates/time_match.h"

namespace glovebench::eval {

/// Time and place of a recording in a capture of the same hand, with 95% bootstrap intervals over blocks of a
/// second.
struct CaptureAlignment {
  TimeOffset time;  ///< added to the answers' time stamps
  Eigen::Isometry3d T_camera_capture = Eigen::Isometry3d::Identity();
  double position_95 = 0;  ///< of the transform, at the hand's mean place, m
  double rotation_95 = 0;  ///< rad
  double residual = 0;     ///< RMS distance of the palm, or of joints, after alignment, m
  size_t used = 0;         ///< answers
  size_t left_out = 0;     ///< answers that are farther off than three medians
};

/// Finds the time offset with the least mean square distance between answers and capture, among the offsets that
/// put half of the tracked answers into the capture; the transform of each is Horn's. `capture` is in its own
/// frame and is interpolated.
/// Throws: Error for fewer than 10 tracked answers, answers without place or scale, or a hand that does not move.
CaptureAlignment align_to_capture(std::span<const HandFrame> capture, std::span<const TrackResult> answers,
                                  const render::Subject& subject, const HandModel& hand, const std::string& where);

/// The captured hand at the camera's times, in the camera's frame.
struct CapturedTruth {
  std::vector<HandFrame> frames;  ///< from 0 us on
  std::vector<TrackResult> answers;
};
/// Leaves out answers outside the capture or in gaps over 0.1 s.
/// Throws: Error if none is left.
CapturedTruth captured_truth(std::span<const HandFrame> capture, std::span<const TrackResult> answers,
                             const CaptureAlignment& alignment, const std::string& where);

}  // namespace glovebench::eval
