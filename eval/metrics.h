#pragma once

#include <span>
#include <vector>

#include "core/hand/hand_model.h"
#include "core/tracker/track_result.h"
#include "reports/results.h"
#include "trajectories/trajectory.h"

namespace glovebench::eval {

/// A frame counts as covered below these errors.
inline constexpr double kCoveredPosition_mm = 50;
inline constexpr double kCoveredRotation_deg = 30;
/// A joint angle counts as observed when at least this many pixels of what it moves are visible.
inline constexpr int kObservedPixels = 30;

/// The truth of one frame, with what the depth camera could see of it.
struct FrameTruth {
  Posture posture = Posture::Zero();
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();
  JointPoses T_hand_joint;                        ///< of the hand that was rendered
  std::array<int, kPatchCount> visible_pixels{};  ///< of each patch, in the IR camera
  bool trackable = false;  ///< enough of the glove is visible within the working volume, and no border cuts it
};

/// Visible pixels of each patch, from an image of patch + 1.
std::array<int, kPatchCount> count_patches(const Image<uint8_t>& patch_image);

/// The geodesic angle between two rotations, degrees.
double rotation_error_deg(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);

struct FrameErrors {
  reports::FrameRecord record;
  std::vector<double> joint_errors_mm;  ///< one a joint but the forearm; empty for a lost frame
};

/// One estimate against the truth. The vertex error poses the tracker's own mesh twice, so that it measures posture
/// and pose, not the size of the hand: no vertex is compared with one of another mesh, and the error says nothing
/// about the surface of a subject with another one. Fingertips and joints are those of the hand that was rendered.
/// A tracked estimate or a truth that is not finite is a broken invariant.
FrameErrors measure_frame(int frame, const TrackResult& estimate, const FrameTruth& truth,
                          const HandModel& tracker_model);

/// Jitter: root mean square change, from one frame to the next, of the position and rotation error while the truth
/// is at rest (under 1 mm, 0.5 degrees and 0.5 degrees of posture a frame). Latency: the delay of the posture, in
/// frames, for which it agrees best with the truth (0..10, parabola through the best three); only if the truth's
/// posture moves, over at least 30 frames. Lost frames are in neither.
reports::SequenceMetrics measure_sequence(std::span<const TrackResult> estimates,
                                          std::span<const trajectories::TrajectoryFrame> truth);

}  // namespace glovebench::eval
