#include "core/tracker/smoother.h"

namespace glovebench {

TrackResult Smoother::smooth(TrackResult result) {
  if (result.status != TrackStatus::tracked) {
    if (++lost_frames_ >= config_.forget_after) started_ = false;
    result.posture = posture_;
    result.T_camera_hand = T_camera_hand_;
    return result;
  }
  lost_frames_ = 0;
  if (started_) {
    const double keep = config_.posture_keep;
    posture_ = keep * posture_ + (1 - keep) * result.posture_unfiltered;
    const Eigen::Isometry3d& measured = result.T_camera_hand_unfiltered;
    const double turn = 1 - config_.pose_keep;
    const Eigen::Quaterniond q =
        Eigen::Quaterniond(T_camera_hand_.linear()).slerp(turn, Eigen::Quaterniond(measured.linear()));
    const Eigen::Vector3d p = config_.pose_keep * T_camera_hand_.translation() + turn * measured.translation();
    T_camera_hand_ = turn == 1 ? measured : Eigen::Isometry3d(Eigen::Translation3d(p) * q.normalized());
  } else {
    posture_ = result.posture_unfiltered;
    T_camera_hand_ = result.T_camera_hand_unfiltered;
    started_ = true;
  }
  result.posture = posture_;
  result.T_camera_hand = T_camera_hand_;
  return result;
}

}  // namespace glovebench
