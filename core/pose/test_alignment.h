#pragma once

#include "core/base/math.h"
#include "core/base/random.h"
#include "core/cloud/labeled_cloud.h"
#include "render/label_renderer.h"
#include "render/test_hand.h"

namespace glovebench {

using render::test_hand;
using render::test_pose;

inline constexpr PinholeCamera kKinect{640, 480, 575.816, 575.816, 319.5, 239.5};

inline PosedHand posed() { return test_hand().pose(render::test_posture()); }

inline RecycledVector<LabeledPoint> true_cloud(const Eigen::Isometry3d& T_camera_hand) {
  render::LabelRenderer renderer;
  const HandImages images = renderer.render_ids(test_hand(), posed(), kKinect, T_camera_hand);
  return build_cloud(images.depth, images.label, kKinect, WorkingVolume{}).points;
}

inline double distance_mm(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return 1000 * (a.translation() - b.translation()).norm();
}
inline double angle_deg(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return degrees_from_radians(Eigen::Quaterniond(a.linear()).angularDistance(Eigen::Quaterniond(b.linear())));
}

inline Eigen::Vector3d random_direction(RandomStream& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

inline Eigen::Isometry3d perturbed(const Eigen::Isometry3d& T_camera_hand, int number) {
  RandomStream random(1, "icp", number, "start");
  const Eigen::AngleAxisd turn(radians_from_degrees(random.uniform(0, 20)), random_direction(random));
  Eigen::Isometry3d start = T_camera_hand;
  start.linear() = turn * T_camera_hand.linear();
  start.translation() += random.uniform(0, 0.030) * random_direction(random);
  return start;
}

inline Eigen::Isometry3d perturbed_by(const Eigen::Isometry3d& T_camera_hand, double angle_deg, double distance,
                                      int number) {
  RandomStream random(1, "icp", number, "far start");
  Eigen::Isometry3d start = T_camera_hand;
  start.linear() =
      Eigen::AngleAxisd(radians_from_degrees(angle_deg), random_direction(random)) * T_camera_hand.linear();
  start.translation() += distance * random_direction(random);
  return start;
}

}  // namespace glovebench
