#pragma once

#include "core/pose/icp.h"
#include "core/pose/matcher.h"

namespace glovebench {

/// The width of the robust alignment's weights as a share of the textbook's. It was chosen on frames of the five
/// source trajectories; bench/README.md has what it gives on others.
inline constexpr double kRobustWidth = 0.6;

/// An alignment that is not the paper's: it starts as Horn's, whose basin is wide, and
/// ends with point-to-plane steps (Chen and Medioni 1991), which settle in few iterations and, with Tukey's
/// weights, look away from points on a wrong patch. On a fifth of the points three steps of Horn, three on the
/// normals and in part on the points themselves, three on the normals; then two on the normals with all points. The
/// faces are culled anew for the last two, and before each step if so configured.
///
/// `points`: at least 3, camera frame. `width`: above 0, others than the default for studies. `iterations`: the
/// steps taken, 11, or fewer if `max_iterations` is less. `converged`: the last step changed the mean distance by
/// at most a hundredth, or by `convergence_share` if that is more; else `not_converged`. `residual` and the other
/// statuses are Horn's.
Alignment align_robust(const HandModel& model, const PosedHand& hand, RecycledVector<LabeledPoint> points,
                       const Eigen::Isometry3d& T_camera_hand_coarse, const IcpConfig& config,
                       double width = kRobustWidth);

}  // namespace glovebench
