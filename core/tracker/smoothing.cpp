#include "core/tracker/smoothing.h"

#include <algorithm>

namespace glovebench {

const TrackResult* last_tracked(std::span<const TrackResult> previous, int count) {
  const auto newest = previous.last(std::min(previous.size(), static_cast<size_t>(count)));
  const auto found = std::find_if(newest.rbegin(), newest.rend(),
                                  [](const TrackResult& result) { return result.status == TrackStatus::tracked; });
  return found == newest.rend() ? nullptr : &*found;
}

TrackResult smoothed(TrackResult result, std::span<const TrackResult> previous, const SmoothingConfig& config) {
  if (result.status != TrackStatus::tracked) {
    if (previous.empty()) return result;
    result.posture = previous.back().posture;
    result.T_camera_hand = previous.back().T_camera_hand;
    return result;
  }
  const Eigen::Isometry3d& measured = result.T_camera_hand_unfiltered;
  const TrackResult* last = last_tracked(previous, config.forget_after);
  if (last == nullptr) {
    result.posture = result.posture_unfiltered;
    result.T_camera_hand = measured;
    return result;
  }
  const double keep = config.posture_keep;
  result.posture = keep * last->posture + (1 - keep) * result.posture_unfiltered;
  const double turn = 1 - config.pose_keep;
  const Eigen::Quaterniond q =
      Eigen::Quaterniond(last->T_camera_hand.linear()).slerp(turn, Eigen::Quaterniond(measured.linear()));
  const Eigen::Vector3d p = config.pose_keep * last->T_camera_hand.translation() + turn * measured.translation();
  result.T_camera_hand = turn == 1 ? measured : Eigen::Isometry3d(Eigen::Translation3d(p) * q.normalized());
  return result;
}

}  // namespace glovebench
