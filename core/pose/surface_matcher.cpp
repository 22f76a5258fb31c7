#include "core/pose/surface_matcher.h"

namespace glovebench {

Eigen::Vector3f viewpoint_hand(const Eigen::Isometry3d& T_camera_hand) {
  return T_camera_hand.inverse().translation().cast<float>();
}

SurfaceMatcher::SurfaceMatcher(const HandModel& model, const PosedHand& hand, RecycledVector<LabeledPoint> cloud,
                               const IcpConfig& config)
    : model_(model),
      hand_(hand),
      cloud_(std::move(cloud)),
      implementation_(config.implementation),
      coloring_(config.color_sensitive ? Surface::Coloring::by_color : Surface::Coloring::any_color),
      points_hand_(cloud_) {}

void SurfaceMatcher::cull(const Eigen::Isometry3d& T_camera_hand) {
  surface_.assign(model_, hand_, viewpoint_hand(T_camera_hand), coloring_);
  if (implementation_ == Implementation::fast) search_.start(surface_);
}

void SurfaceMatcher::match(const Eigen::Isometry3d& T_camera_hand) {
  // The search runs in the hand frame: moving the points by the inverse pose is the same as moving the hand.
  const Eigen::Isometry3f T = T_camera_hand.inverse().cast<float>();
  for (size_t i = 0; i < cloud_.size(); ++i) points_hand_[i].p = T * cloud_[i].p;
  if (implementation_ == Implementation::plain) {
    plain_ = closest_points_plain(points_hand_, surface_);
    closest_ = plain_;
  } else {
    closest_ = search_(points_hand_);
  }
}

}  // namespace glovebench
