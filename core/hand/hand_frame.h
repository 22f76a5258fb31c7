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

enum class Appearance { glove, skin };
constexpr auto names_of(Appearance) { return std::to_array<std::string_view>({"glove", "skin"}); }

}  // namespace glovebench
