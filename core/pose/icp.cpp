#include "core/pose/icp.h"

#include "core/pose/closest_point.h"
#include "core/pose/horn.h"

namespace glovebench {
namespace {

Eigen::Vector3f viewpoint(const Eigen::Isometry3d& T_camera_hand) {
  return T_camera_hand.inverse().translation().cast<float>();
}

/// The search runs in the hand frame: moving the points by the inverse pose is the same as moving the hand.
std::vector<LabeledPoint> in_hand_frame(std::span<const LabeledPoint> points,
                                        const Eigen::Isometry3d& T_camera_hand) {
  const Eigen::Isometry3f T = T_camera_hand.inverse().cast<float>();
  std::vector<LabeledPoint> result(points.begin(), points.end());
  for (LabeledPoint& point : result) point.p = T * point.p;
  return result;
}

struct Pairs {
  std::vector<Eigen::Vector3f> model_camera;
  std::vector<Eigen::Vector3f> cloud_camera;
  double mean_distance = 0;
};

Pairs make_pairs(std::span<const LabeledPoint> cloud, std::span<const ClosestPoint> closest,
                 const Eigen::Isometry3d& T_camera_hand) {
  Pairs pairs;
  const Eigen::Isometry3f T = T_camera_hand.cast<float>();
  double sum = 0;
  for (size_t i = 0; i < cloud.size(); ++i) {
    if (closest[i].face < 0) continue;
    pairs.model_camera.push_back(T * closest[i].p_hand);
    pairs.cloud_camera.push_back(cloud[i].p);
    sum += closest[i].distance;
  }
  if (!pairs.cloud_camera.empty()) pairs.mean_distance = sum / static_cast<double>(pairs.cloud_camera.size());
  return pairs;
}

/// The points of a cloud that take part, with the labels under which a surface keeps its faces.
std::vector<LabeledPoint> points_to_align(std::span<const LabeledPoint> cloud, const IcpConfig& config) {
  std::vector<LabeledPoint> points = config.subsampling_factor > 0 ? every_nth(cloud, config.subsampling_factor)
                                                                   : subsample(cloud, config.max_points);
  if (!config.color_sensitive) {
    for (LabeledPoint& point : points) point.label = Surface::kAnyColor;
  }
  return points;
}

}  // namespace

std::vector<LabeledPoint> every_nth(std::span<const LabeledPoint> points, size_t n) {
  std::vector<LabeledPoint> result;
  for (size_t i = 0; i < points.size(); i += n) result.push_back(points[i]);
  return result;
}

std::vector<LabeledPoint> subsample(std::span<const LabeledPoint> points, int max_points) {
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
  const Surface surface(model, hand, viewpoint(T));
  T.translation() = center - R_camera_hand * surface.center().cast<double>();
  return T;
}

Alignment align(const HandModel& model, const PosedHand& hand, std::span<const LabeledPoint> cloud,
                const Eigen::Isometry3d& T_camera_hand_coarse, const IcpConfig& config) {
  const std::vector<LabeledPoint> points = points_to_align(cloud, config);
  Alignment result;
  result.T_camera_hand = T_camera_hand_coarse;
  result.points = static_cast<int>(points.size());
  if (points.size() < 3) return result;

  const auto coloring = config.color_sensitive ? Surface::Coloring::by_color : Surface::Coloring::any_color;
  Surface surface(model, hand, viewpoint(result.T_camera_hand), coloring);
  std::optional<ClosestPointSearch> search(surface);
  const auto pairs_now = [&] {
    return make_pairs(points, (*search)(in_hand_frame(points, result.T_camera_hand)), result.T_camera_hand);
  };
  Pairs pairs = pairs_now();
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
    if (config.cull_each_iteration) {
      surface = Surface(model, hand, viewpoint(result.T_camera_hand), coloring);
      search.emplace(surface);
    }
    pairs = pairs_now();
    const double change = std::abs(result.residual - pairs.mean_distance);
    if (change <= config.convergence_share * result.residual) {
      result.residual = pairs.mean_distance;
      result.status = AlignmentStatus::converged;
      return result;
    }
  }
}

}  // namespace glovebench
