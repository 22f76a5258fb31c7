#pragma once

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <string_view>

#include "core/base/implementation.h"
#include "core/cloud/labeled_cloud.h"
#include "core/hand/hand_model.h"

namespace glovebench {

struct IcpConfig {
  std::string algorithm = "horn";    ///< how the closest points move the hand: a name of `alignments`
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

/// An alignment: X_alignment.cpp in core/pose/alignments defines `AlignmentEntry X_alignment()`.
struct AlignmentEntry {
  std::string_view name;         ///< X
  std::string_view description;  ///< one line
  /// `points`: at least 3, camera frame, m, with the labels under which a surface keeps its faces. `config` limits
  /// the iterations.
  Alignment (*align)(const HandModel& model, const PosedHand& hand, RecycledVector<LabeledPoint> points,
                     const Eigen::Isometry3d& T_camera_hand_coarse, const IcpConfig& config);
};
/// All of that folder, sorted by name.
std::span<const AlignmentEntry> alignments();

/// Color-sensitive iterative closest point-to-triangle (section III-C, equation 3) of a part of the cloud, by the
/// alignment that `config` names: each point goes to the closest front-facing triangle of its color, or of any.
Alignment align(const HandModel& model, const PosedHand& hand, std::span<const LabeledPoint> cloud,
                const Eigen::Isometry3d& T_camera_hand_coarse, const IcpConfig& config);

}  // namespace glovebench
