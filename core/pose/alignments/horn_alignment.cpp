#include "core/pose/alignment.h"
#include "core/pose/horn.h"
#include "core/pose/surface_matcher.h"

namespace glovebench {
namespace {

struct Pairs {
  RecycledVector<Eigen::Vector3f> model_camera;
  RecycledVector<Eigen::Vector3f> cloud_camera;
  double mean_distance = 0;
};

/// Into `pairs`, whose memory is kept.
void make_pairs(const SurfaceMatcher& matcher, const Eigen::Isometry3d& T_camera_hand, Pairs& pairs) {
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

/// Until the mean distance settles.
Alignment align_horn(const HandModel& model, const PosedHand& hand, RecycledVector<LabeledPoint> points,
                     const Eigen::Isometry3d& T_camera_hand_coarse, const IcpConfig& config) {
  Alignment result;
  result.T_camera_hand = T_camera_hand_coarse;
  result.points = static_cast<int>(points.size());
  SurfaceMatcher matcher(model, hand, std::move(points), config);
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

AlignmentEntry horn_alignment() {
  return {"horn", "the paper's (section III-C): Horn's alignment of all points in each iteration", align_horn};
}

}  // namespace glovebench
