#pragma once

#include <array>
#include <vector>

#include "core/base/image.h"
#include "core/hand/hand_model.h"
#include "core/tracker/track_result.h"
#include "reports/results.h"

namespace glovebench::reports {

/// A frame is covered below these errors.
inline constexpr double kCoveredPosition_mm = 50;
inline constexpr double kCoveredRotation_deg = 30;
/// A joint angle is observed when at least this many pixels of what it moves are visible.
inline constexpr int kObservedPixels = 30;

/// The truth of one frame, and what the depth camera could see of it.
struct FrameTruth {
  Posture posture = Posture::Zero();
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();
  JointPoses T_hand_joint;                        ///< of the hand that was rendered
  std::array<int, kPatchCount> visible_pixels{};  ///< of each patch, in the IR camera
  bool trackable = false;  ///< enough of the glove is visible within the working volume, and no border cuts it
};

/// A tracked frame beside its truth: what metrics are computed from. All values are finite.
struct MeasuredFrame {
  const TrackResult& estimate;
  const FrameTruth& truth;
  PosedHand estimated_hand, true_hand;  ///< the tracker's mesh in both postures
  /// Distances in the camera's frame, one a joint but the forearm. The true joints are those of the hand that was
  /// rendered.
  std::vector<double> joint_errors_mm;
};

struct FrameErrors {
  FrameRecord record;
  std::vector<double> joint_errors_mm;  ///< MeasuredFrame's; empty for a lost frame
};
/// Computes all metrics of one frame. A tracked estimate or its truth that is not finite is a broken invariant.
FrameErrors measure_frame(int frame, const TrackResult& estimate, const FrameTruth& truth,
                          const HandModel& tracker_model);

/// Visible pixels of each patch, from an image of patch + 1.
std::array<int, kPatchCount> count_patches(const Image<uint8_t>& patch_image);

/// The geodesic angle between two rotations, degrees.
double rotation_error_deg(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);

}  // namespace glovebench::reports
