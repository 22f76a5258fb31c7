#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "core/hand/posture.h"

namespace glovebench {

/// The true hand at one moment: one frame of a trajectory, and what a synthetic camera renders.
struct HandFrame {
  int64_t timestamp_us = 0;
  Posture posture = Posture::Zero();                                ///< rad
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();  ///< m; camera: the IR camera
};

}  // namespace glovebench
