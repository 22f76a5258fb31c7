#pragma once

#include <Eigen/Geometry>
#include <span>

#include "core/pose/closest_point.h"
#include "core/pose/closest_point_search.h"
#include "core/pose/icp.h"

namespace glovebench {

/// Finds for the points of a cloud the closest points on the faces of a posed hand that look at the camera: what an
/// alignment does in each of its iterations, with the implementation that is configured. It keeps its buffers.
class Matcher {
 public:
  /// `model` and `hand` outlive it. Points: camera frame, m, with the labels under which the surface keeps its
  /// faces.
  Matcher(const HandModel& model, const PosedHand& hand, RecycledVector<LabeledPoint> cloud,
          const IcpConfig& config);

  /// Keeps the faces that look at the camera when the hand is here.
  void cull(const Eigen::Isometry3d& T_camera_hand);
  /// The closest points when the hand is here; after `cull`.
  void match(const Eigen::Isometry3d& T_camera_hand);

  const RecycledVector<LabeledPoint>& cloud() const { return cloud_; }
  const Surface& surface() const { return surface_; }
  /// Of the last `match`, for each point of the cloud.
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

/// Where the camera stands in the hand frame.
Eigen::Vector3f viewpoint_hand(const Eigen::Isometry3d& T_camera_hand);

}  // namespace glovebench
