#pragma once

#include <span>

#include "core/camera/rgbd_calibration.h"
#include "core/hand/hand_model.h"

namespace glovebench::reports {

/// Percent of the hand's camera-facing area inside both (rectified) images and the volume of coverage.h. A triangle
/// faces the IR camera if its outside does, even if hidden, and counts where its centroid lies. 0 if none does.
double visible_percent(const PosedHand& hand, std::span<const Triangle> triangles,
                       const Eigen::Isometry3d& T_camera_hand, const RgbdCalibration& calibration);

}  // namespace glovebench::reports
