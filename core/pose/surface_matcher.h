#pragma once

#include <Eigen/Geometry>
#include <span>

#include "core/pose/alignment.h"
#include "core/pose/closest_point.h"
#include "core/pose/closest_point_search.h"

namespace glovebench {

/// Closest points on camera-facing faces.
class SurfaceMatcher {
 public:
  /// `model` and `hand` must outlive it. `cloud`: camera frame, m; labels as the surface's.
  SurfaceMatcher(const HandModel& model, const PosedHand& hand, RecycledVector<LabeledPoint> cloud,
                 const IcpConfig& config);

  /// Keeps the faces that face the camera.
  void cull(const Eigen::Isometry3d& T_camera_hand);
  /// Call after `cull`.
  void match(const Eigen::Isometry3d& T_camera_hand);

  const RecycledVector<LabeledPoint>& cloud() const { return cloud_; }
  const Surface& surface() const { return surface_; }
  const RecycledVector<LabeledPoint>& points_hand() const { return points_hand_; }
  std::span<const ClosestPoint> closest() const { return closest_; }

 private:
  const HandModel& model_;
  const PosedHand& hand_;
  RecycledVector<LabeledPoint> cloud_;
  Implementation implementation_;
  Surface::Coloring coloring_;
  Surface surface_;
  ClosestPointSearch search_;
  RecycledVector<LabeledPoint> points_hand_;
  RecycledVector<ClosestPoint> plain_;
  std::span<const ClosestPoint> closest_;
};

/// The camera in the hand frame, m.
Eigen::Vector3f viewpoint_hand(const Eigen::Isometry3d& T_camera_hand);

}  // namespace glovebench
