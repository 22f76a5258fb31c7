#pragma once

#include <Eigen/Geometry>
#include <span>

#include "core/base/implementation.h"
#include "core/cloud/labeled_cloud.h"
#include "core/hand/hand_model.h"

namespace glovebench {

/// How the closest points move the hand: Horn's alignment in each iteration (the paper), or the schedule of
/// robust_icp.h.
enum class IcpAlgorithm { horn, robust };
constexpr auto names_of(IcpAlgorithm) {
  return std::to_array<std::string_view>({"horn", "robust"});
}

struct IcpConfig {
  IcpAlgorithm algorithm = IcpAlgorithm::horn;
  int max_points = 1000;             ///< uniform stride down to at most this many, >= 3
  int subsampling_factor = 0;        ///< every n-th point (Figure 9); 0: as many as `max_points` allows, >= 0
  int max_iterations = 100;          ///< >= 1
  double convergence_share = 1e-3;   ///< stop when the mean distance changes by less than this share, > 0
  bool cull_each_iteration = false;  ///< back faces: before the first iteration (paper) or in each
  Implementation implementation = Implementation::fast;  ///< of the closest-point search; its answers are the same
  bool color_sensitive = true;  ///< closest triangles of a point's color (paper) or of any color
};

enum class AlignmentStatus { converged, not_converged, too_few_points, degenerate_cloud, no_shared_color };

struct Alignment {
  AlignmentStatus status = AlignmentStatus::too_few_points;
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();
  int points = 0;  ///< taken from the cloud
  int iterations = 0;
  double residual = 0;  ///< mean point-to-triangle distance at the end, m
};

/// The points 0, n, 2n, ... (n >= 1).
RecycledVector<LabeledPoint> every_nth(std::span<const LabeledPoint> points, size_t n);
/// Every n-th point, with the smallest n that leaves at most `max_points`.
RecycledVector<LabeledPoint> subsample(std::span<const LabeledPoint> points, int max_points);

/// The coarse pose of section III-C: rotation from the look-up; the center of gravity of the faces that look at the
/// camera is placed on the cloud's.
Eigen::Isometry3d coarse_pose(const HandModel& model, const PosedHand& hand, const Eigen::Matrix3d& R_camera_hand,
                              std::span<const LabeledPoint> points);

/// Color-sensitive iterative closest point-to-triangle (section III-C, equation 3): each point goes to the closest
/// front-facing triangle of its color (or of any, if so configured), Horn's alignment moves the hand, until the
/// mean distance settles. With `IcpAlgorithm::robust` as `align_robust` says (robust_icp.h).
Alignment align(const HandModel& model, const PosedHand& hand, std::span<const LabeledPoint> cloud,
                const Eigen::Isometry3d& T_camera_hand_coarse, const IcpConfig& config);

}  // namespace glovebench
