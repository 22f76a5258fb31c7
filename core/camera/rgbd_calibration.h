#pragma once

#include <Eigen/Geometry>

#include "core/camera/pinhole_camera.h"

namespace glovebench {

/// What a stereo calibration of a Kinect gives (section III-A). The frame called "camera" everywhere else
/// is the IR (depth) camera.
struct RgbdCalibration {
  PinholeCamera ir;
  PinholeCamera rgb;
  Eigen::Isometry3d T_rgb_ir = Eigen::Isometry3d::Identity();  ///< p_rgb = T_rgb_ir * p_ir, metres
};

/// The one self-consistent calibration of the synthetic Kinect: IR f 575.816 px, RGB f 525 px, principal points
/// near the center, baseline 24 mm, a rotation of under one degree.
RgbdCalibration synthetic_calibration();

}  // namespace glovebench
