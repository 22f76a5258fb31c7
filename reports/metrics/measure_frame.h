#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/base/image.h"
#include "core/hand/hand_model.h"
#include "core/tracker/track_result.h"
#include "reports/results.h"

namespace glovebench::reports {

/// An observed angle moves at least so many visible pixels.
inline constexpr int kObservedPixels = 30;

struct FrameTruth {
  Posture posture = Posture::Zero();
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();
  JointPoses T_hand_joint;                        ///< of the rendered hand
  std::array<int, kPatchCount> visible_pixels{};  ///< per patch, in the IR camera
  bool trackable = false;                         ///< enough glove in the working volume, none cut by the border
  std::optional<double> visible_percent = {};     ///< coverage.h; empty if not requested
};

/// All values are finite.
struct MeasuredFrame {
  const TrackResult& estimate;
  const FrameTruth& truth;
  PosedHand estimated_hand, true_hand;  ///< tracker's mesh in both postures
  // By joint without the forearm, camera frame, m. True joints are the rendered hand's. Empty: not estimated.
  std::vector<std::optional<Eigen::Vector3d>> joints;
  std::vector<Eigen::Vector3d> true_joints;
  std::vector<std::optional<double>> joint_errors_mm;
};

struct FrameErrors {
  FrameRecord record;
  std::vector<std::optional<double>> joint_errors_mm;  ///< by joint; empty if lost
};
/// Empty if one of the joints is not estimated.
std::optional<double> mean_error_mm(const MeasuredFrame& frame, std::span<const int> joints);

/// Metrics whose needs the estimate meets. A tracked estimate must be finite.
FrameErrors measure_frame(int frame, const TrackResult& estimate, const FrameTruth& truth,
                          const HandModel& tracker_model);

/// `patch_image`: patch + 1.
std::array<int, kPatchCount> count_patches(const Image<uint8_t>& patch_image);

}  // namespace glovebench::reports
