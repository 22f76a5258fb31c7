#pragma once

#include "core/pose/icp.h"
#include "core/pose/matcher.h"

namespace glovebench {

/// Width of Tukey's weights relative to the textbook's, chosen on the source trajectories (bench/README.md).
inline constexpr double kRobustWidth = 0.6;

/// Aligns in 11 steps (not the paper's): on a fifth of the points three of Horn, three mixed and three
/// point-to-plane (Chen and Medioni 1991) with Tukey's weights; then two point-to-plane on all points. Horn's basin
/// is wide; planes settle fast.
/// `points`: at least 3, camera frame. `width` > 0. Converged if all steps were taken and the last changed the mean
/// distance by at most 1% or `convergence_share`.
Alignment align_robust(const HandModel& model, const PosedHand& hand, RecycledVector<LabeledPoint> points,
                       const Eigen::Isometry3d& T_camera_hand_coarse, const IcpConfig& config,
                       double width = kRobustWidth);

}  // namespace glovebench
