#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "core/camera/rgbd_calibration.h"
#include "core/hand/hand_model.h"

namespace glovebench::reports {

struct FrameRecord;

// These rules are part of the protocol.

/// Least visible_percent of a visible hand.
inline constexpr double kVisible_percent = 30;
inline constexpr double kVolumeNear_mm = 400, kVolumeFar_mm = 950;  ///< z in the IR camera's frame
/// A frame is found, or "covered", below these errors.
inline constexpr double kFoundPosition_mm = 50, kFoundRotation_deg = 30;
/// A frame is usable below these errors.
inline constexpr double kUsablePosition_mm = 10, kUsableRotation_deg = 10;
inline constexpr double kUsableFingertips_mm = 20;  ///< mean of the five

std::map<std::string, double> coverage_rules();

// Errors are compared to 1e-6, as in files.

/// False for frames of older results.
bool is_visible(const FrameRecord& frame);
/// Tracked within the usable errors. Empty if the estimate lacks pose or fingertips; ignores other missing errors.
std::optional<bool> is_usable(const FrameRecord& frame);

/// Percentage of the hand's area facing the IR camera that is inside both (rectified) images and the volume. Counts
/// hidden triangles. A triangle is where its centroid is. 0 if none faces the camera.
double visible_percent(const PosedHand& hand, std::span<const Triangle> triangles,
                       const Eigen::Isometry3d& T_camera_hand, const RgbdCalibration& calibration);

}  // namespace glovebench::reports
