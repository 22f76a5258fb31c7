#include "core/pose/alignment.h"

#include "core/base/registry.h"
#include "core/pose/closest_point.h"
#include "core/pose/surface_matcher.h"

namespace glovebench {
namespace {

/// The points of a cloud that take part, with the labels under which a surface keeps its faces.
RecycledVector<LabeledPoint> points_to_align(std::span<const LabeledPoint> cloud, const IcpConfig& config) {
  RecycledVector<LabeledPoint> points = config.subsampling_factor > 0 ? every_nth(cloud, config.subsampling_factor)
                                                                      : subsample(cloud, config.max_points);
  if (!config.color_sensitive)
    for (LabeledPoint& point : points) point.label = Surface::kAnyColor;
  return points;
}

}  // namespace

RecycledVector<LabeledPoint> every_nth(std::span<const LabeledPoint> points, size_t n) {
  RecycledVector<LabeledPoint> result;
  for (size_t i = 0; i < points.size(); i += n) result.push_back(points[i]);
  return result;
}

RecycledVector<LabeledPoint> subsample(std::span<const LabeledPoint> points, int max_points) {
  return every_nth(points, std::max<size_t>(1, (points.size() + max_points - 1) / max_points));
}

Eigen::Isometry3d coarse_pose(const HandModel& model, const PosedHand& hand, const Eigen::Matrix3d& R_camera_hand,
                              std::span<const LabeledPoint> points, bool center_visible_surface) {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const LabeledPoint& point : points) center += point.p.cast<double>();
  if (!points.empty()) center /= static_cast<double>(points.size());
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = R_camera_hand;
  T.translation() = center;
  if (!center_visible_surface) return T;
  T.translation() = center - R_camera_hand * seen_center(model, hand, viewpoint_hand(T)).cast<double>();
  return T;
}

Alignment align(const HandModel& model, const PosedHand& hand, std::span<const LabeledPoint> cloud,
                const Eigen::Isometry3d& T_camera_hand_coarse, const IcpConfig& config) {
  const AlignmentEntry& alignment = find_in(alignments(), config.algorithm, "alignment", "name");
  RecycledVector<LabeledPoint> points = points_to_align(cloud, config);
  if (points.size() < 3) return {.T_camera_hand = T_camera_hand_coarse, .points = static_cast<int>(points.size())};
  return alignment.align(model, hand, std::move(points), T_camera_hand_coarse, config);
}

}  // namespace glovebench
