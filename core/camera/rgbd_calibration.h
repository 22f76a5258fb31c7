#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>
#include <string>

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

/// Reads {"version": 1, "ir": CAMERA, "rgb": CAMERA, "T_rgb_ir": {"rotation": 3 rows of 3, "translation_m": 3}}
/// with CAMERA = {"width_px", "height_px", "fx_px", "fy_px", "cx_px", "cy_px"}. Every key is required and no other
/// is allowed. Throws Error naming `where` and the field; numbers must be finite, focal lengths positive, the
/// rotation orthonormal (1e-6) and right-handed.
RgbdCalibration calibration_from_json(const nlohmann::json& json, const std::string& where);
nlohmann::json to_json(const RgbdCalibration& calibration);

/// A calibration file; what is saved is loaded again bit for bit. Both throw Error.
RgbdCalibration load_calibration(const std::string& path);
void save_calibration(const RgbdCalibration& calibration, const std::string& path);

}  // namespace glovebench
