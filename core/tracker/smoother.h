#pragma once

#include "core/tracker/track_result.h"
#include "core/tracker/tracker_config.h"

namespace glovebench {

/// Recursive filter x = keep * previous + (1 - keep) * new of the posture and, if configured, the pose.
/// Paper: section III-C, as its printed numbers show.
class Smoother {
 public:
  explicit Smoother(const SmoothingConfig& config) : config_(config) {}
  /// Fills the smoothed values of a result. A lost frame repeats the last ones.
  TrackResult smooth(TrackResult result);

 private:
  SmoothingConfig config_;
  bool started_ = false;
  int lost_frames_ = 0;
  Posture posture_ = Posture::Zero();
  Eigen::Isometry3d T_camera_hand_ = Eigen::Isometry3d::Identity();
};

}  // namespace glovebench
