#pragma once

#include "core/tracker/track_result.h"
#include "core/tracker/tracker_config.h"

namespace glovebench {

/// The smoothing of section III-C as its printed numbers show it: the recursive filter x = keep * previous +
/// (1 - keep) * new, on the posture and, if configured, on the pose.
class Smoother {
 public:
  explicit Smoother(const SmoothingConfig& config) : config_(config) {}
  /// Fills the smoothed posture and pose of a result from its unfiltered ones. A lost frame repeats the last
  /// smoothed values.
  TrackResult smooth(TrackResult result);

 private:
  SmoothingConfig config_;
  bool started_ = false;
  int lost_frames_ = 0;
  Posture posture_ = Posture::Zero();
  Eigen::Isometry3d T_camera_hand_ = Eigen::Isometry3d::Identity();
};

}  // namespace glovebench
