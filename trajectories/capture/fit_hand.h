#pragma once

#include <string>
#include <vector>

#include "trajectories/capture/capture_hand.h"
#include "trajectories/capture/marker_sequence.h"

namespace glovebench::trajectories {

struct FittedFrame {
  int64_t timestamp_us = 0;
  HandState state;
  int points = 0;  ///< after relabeling
  int labels_corrected = 0;
  std::vector<double> residuals;  ///< by point, m
  std::array<bool, kAngleCount> bridged_angles = {};
  bool bridged_pose = false;
  bool left_out = false;  ///< in a gap over kLongestPoseGapUs, or at an end
};

inline constexpr int64_t kLongestPoseGapUs = 500'000;

struct HandFit {
  CaptureHand hand;
  double scale = 1;  ///< of the model, before calibration
  std::vector<FittedFrame> frames;
  std::array<bool, kAngleCount> never_shown = {};
  int angle_gaps = 0;
  int missing_points = 0;  ///< of labeled markers
};

/// Fits a right hand and its movement. `markers`: from place_markers.
/// Throws: Error if the capture is no hand.
HandFit fit_hand(const MarkerSequence& sequence, const std::vector<PlacedMarker>& markers, const Skeleton& skeleton,
                 const std::string& where);

}  // namespace glovebench::trajectories
