#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "core/hand/posture.h"

namespace glovebench {

struct HandFrame {
  int64_t timestamp_us = 0;
  Posture posture = Posture::Zero();                                ///< rad
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();  ///< m; IR camera
};

}  // namespace glovebench
