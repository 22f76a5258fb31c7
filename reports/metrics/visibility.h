#pragma once

#include <span>

#include "core/camera/rgbd_calibration.h"
#include "core/hand/hand_model.h"

namespace glovebench::reports {

/// Percentage of the hand's area facing the IR camera that is inside both (rectified) images and coverage.h's
/// volume. Counts hidden triangles. A triangle is where its centroid is. 0 if none faces the camera.
double visible_percent(const PosedHand& hand, std::span<const Triangle> triangles,
                       const Eigen::Isometry3d& T_camera_hand, const RgbdCalibration& calibration);

}  // namespace glovebench::reports
