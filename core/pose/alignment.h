#pragma once

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <string_view>

#include "core/base/enum_names.h"
#include "core/cloud/labeled_cloud.h"
#include "core/hand/hand_model.h"

namespace glovebench {

/// Equal results. `plain` follows the paper line by line.
enum class Implementation { plain, fast };
constexpr auto names_of(Implementation) { return std::to_array<std::string_view>({"plain", "fast"}); }

struct IcpConfig {
  std::string algorithm = "horn";  ///< a name of `alignments`
  bool center_visible_surface =
      true;                          ///< the visible surface starts at the cloud's center; false: the hand's origin
  int max_points = 1000;             ///< uniform stride, >= 3
  int subsampling_factor = 0;        ///< every nth point (Figure 9); 0: by `max_points`
  int max_iterations = 100;          ///< >= 1
  double convergence_share = 1e-3;   ///< stop if the mean distance changes by a smaller share, > 0
  bool cull_each_iteration = false;  ///< false: only at the start (the paper)
  Implementation implementation = Implementation::fast;  ///< of the closest-point search
  bool color_sensitive = true;                           ///< false: any color
};

enum class AlignmentStatus { converged, not_converged, too_few_points, degenerate_cloud, no_shared_color };

struct Alignment {
  AlignmentStatus status = AlignmentStatus::too_few_points;
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();
  int points = 0;
  int iterations = 0;
  double residual = 0;  ///< final mean point-to-triangle distance, m
};

RecycledVector<LabeledPoint> every_nth(std::span<const LabeledPoint> points, size_t n);
/// Every nth point, for the smallest n that leaves at most `max_points`.
RecycledVector<LabeledPoint> subsample(std::span<const LabeledPoint> points, int max_points);

/// Has the given rotation. Puts the center of the camera-facing faces, else the hand's origin, at the center of
/// `points` (camera frame, m).
/// Paper: section III-C.
Eigen::Isometry3d coarse_pose(const HandModel& model, const PosedHand& hand, const Eigen::Matrix3d& R_camera_hand,
                              std::span<const LabeledPoint> points, bool center_visible_surface = true);

/// core/pose/alignments/X_alignment.cpp defines `AlignmentEntry X_alignment()`. `align` sets all fields of the
/// result, obeys `max_iterations` and `cull_each_iteration`, and matches by `SurfaceMatcher`, which obeys
/// `implementation` and `color_sensitive`.
struct AlignmentEntry {
  std::string_view name;
  std::string_view description;
  /// `points`: at least 3, camera frame, m; labels as the surface's.
  Alignment (*align)(const HandModel& model, const PosedHand& hand, RecycledVector<LabeledPoint> points,
                     const Eigen::Isometry3d& T_camera_hand_coarse, const IcpConfig& config);
};
std::span<const AlignmentEntry> alignments();

/// Aligns subsampled points with the closest visible triangles of their colors.
/// Throws: Error for an unknown algorithm.
/// Paper: section III-C, equation (3).
Alignment align(const HandModel& model, const PosedHand& hand, std::span<const LabeledPoint> cloud,
                const Eigen::Isometry3d& T_camera_hand_coarse, const IcpConfig& config);

}  // namespace glovebench
