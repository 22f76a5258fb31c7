#pragma once

#include <string>
#include <vector>

#include "trajectories/capture/bridge_gaps.h"
#include "trajectories/capture/capture_hand.h"
#include "trajectories/capture/marker_sequence.h"

namespace glovebench::trajectories {

/// One frame of a fit.
struct FittedFrame {
  int64_t timestamp_us = 0;
  HandState state;
  int points = 0;  ///< that the markers have, after sorting
  int labels_corrected = 0;
  std::vector<double> residuals;  ///< of each point, m
  std::array<bool, kAngleCount> bridged_angles = {};
  bool bridged_pose = false;
  bool left_out = false;  ///< its pose is not known: in a gap longer than kLongestPoseGapUs, or at an end
};

inline constexpr int64_t kLongestPoseGapUs = 500'000;

/// What a capture says about a hand.
struct HandFit {
  CaptureHand hand;
  double scale = 1;  ///< of the model's hand, before its parts were fitted
  std::vector<FittedFrame> frames;
  std::array<bool, kAngleCount> never_shown = {};
  int angle_gaps = 0;
  int missing_points = 0;  ///< of labeled markers, in all frames
};

/// Finds the joint angles and poses of a right hand that put the model's markers onto the captured points: pose of
/// the palm (Horn), angles frame by frame, then the person's hand (palm, segments, markers) over the frames that
/// differ most, labels by where the model says each marker is, angles again, gaps. `markers` are the sequence's
/// labeled points (place_markers); `where` names the capture in messages. Throws Error if the capture is no hand:
/// in a wrong unit, with too few points on the palm in all frames, or nowhere like one.
HandFit fit_hand(const MarkerSequence& sequence, const std::vector<PlacedMarker>& markers, const Skeleton& skeleton,
                 const std::string& where);

}  // namespace glovebench::trajectories
