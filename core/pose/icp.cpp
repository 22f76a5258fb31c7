#include "core/pose/icp.h"

#include "core/pose/horn.h"
#include "core/pose/matcher.h"
#include "core/pose/robust_icp.h"

namespace glovebench {
namespace {

struct Pairs {
  RecycledVector<Eigen::Vector3f> model_camera;
  RecycledVector<Eigen::Vector3f> cloud_camera;
  double mean_distance = 0;
};

/// Into `pairs`, whose memory is kept.
void make_pairs(const Matcher& matcher, const Eigen::Isometry3d& T_camera_hand, Pairs& pairs) {
  pairs.model_camera.clear();
  pairs.cloud_camera.clear();
  const Eigen::Isometry3f T = T_camera_hand.cast<float>();
  double sum = 0;
  const LabeledPoint* point = matcher.cloud().data();
  for (const ClosestPoint& closest : matcher.closest()) {
    const LabeledPoint& paired = *point++;
    if (closest.face < 0) continue;
    pairs.model_camera.push_back(T * closest.p_hand);
    pairs.cloud_camera.push_back(paired.p);
    sum += closest.distance;
  }
  pairs.mean_distance = pairs.cloud_camera.empty() ? 0 : sum / static_cast<double>(pairs.cloud_camera.size());
}

/// The points of a cloud that take part, with the labels under which a surface keeps its faces.
RecycledVector<LabeledPoint> points_to_align(std::span<const LabeledPoint> cloud, const IcpConfig& config) {
  RecycledVector<LabeledPoint> points = config.subsampling_factor > 0 ? every_nth(cloud, config.subsampling_factor)
                                                                      : subsample(cloud, config.max_points);
  if (!config.color_sensitive) {
    for (LabeledPoint& point : points) point.label = Surface::kAnyColor;
  }
  return points;
}

/// Section III-C: Horn's alignment of all points in each iteration, from the pose in `start`.
Alignment align_horn(Matcher& matcher, const Alignment& start, const IcpConfig& config) {
  Alignment result = start;
  Pairs pairs;
  const auto pair_now = [&] {
    matcher.match(result.T_camera_hand);
    make_pairs(matcher, result.T_camera_hand, pairs);
  };
  matcher.cull(result.T_camera_hand);
  pair_now();
  while (true) {
    if (pairs.cloud_camera.size() < 3) {
      result.status = AlignmentStatus::no_shared_color;
      return result;
    }
    result.residual = pairs.mean_distance;
    if (result.iterations == config.max_iterations) {
      result.status = AlignmentStatus::not_converged;
      return result;
    }
    const std::optional<Eigen::Isometry3d> T_k = align_points(pairs.model_camera, pairs.cloud_camera);
    if (!T_k) {
      result.status = AlignmentStatus::degenerate_cloud;
      return result;
    }
    result.T_camera_hand = *T_k * result.T_camera_hand;
    ++result.iterations;
    if (config.cull_each_iteration) matcher.cull(result.T_camera_hand);
    pair_now();
    const double change = std::abs(result.residual - pairs.mean_distance);
    if (change <= config.convergence_share * result.residual) {
      result.residual = pairs.mean_distance;
      result.status = AlignmentStatus::converged;
      return result;
    }
  }
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
                              std::span<const LabeledPoint> points) {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const LabeledPoint& point : points) center += point.p.cast<double>();
  if (!points.empty()) center /= static_cast<double>(points.size());
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = R_camera_hand;
  T.translation() = center;
  T.translation() = center - R_camera_hand * seen_center(model, hand, viewpoint_hand(T)).cast<double>();
  return T;
}

Alignment align(const HandModel& model, const PosedHand& hand, std::span<const LabeledPoint> cloud,
                const Eigen::Isometry3d& T_camera_hand_coarse, const IcpConfig& config) {
  Alignment start;
  start.T_camera_hand = T_camera_hand_coarse;
  RecycledVector<LabeledPoint> points = points_to_align(cloud, config);
  start.points = static_cast<int>(points.size());
  if (points.size() < 3) return start;
  if (config.algorithm == IcpAlgorithm::robust) {
    return align_robust(model, hand, points, T_camera_hand_coarse, config);
  }
  Matcher matcher(model, hand, std::move(points), config);
  return align_horn(matcher, start, config);
}

}  // namespace glovebench
