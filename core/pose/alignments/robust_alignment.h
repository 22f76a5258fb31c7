#pragma once

#include "core/pose/alignment.h"
#include "core/pose/surface_matcher.h"

namespace glovebench {

/// Width of Tukey's weights relative to the textbook's (bench/README.md).
inline constexpr double kRobustWidth = 0.5;

/// Aligns by Horn's and point-to-plane steps (Chen and Medioni 1991) under Tukey's weights: 9 steps on a fifth of
/// the points, 2 on all. Not in the paper. `points`: at least 3, camera frame. `width` > 0. `converged`: all steps
/// were taken, and the last changed the mean distance by at most 1% or `convergence_share`.
Alignment align_robust(const HandModel& model, const PosedHand& hand, RecycledVector<LabeledPoint> points,
                       const Eigen::Isometry3d& T_camera_hand_coarse, const IcpConfig& config,
                       double width = kRobustWidth);

}  // namespace glovebench
