#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/camera/pinhole_camera.h"

namespace glovebench {

/// z = 1 / (a raw + b); raw: 11-bit disparity. a = -1/(8fB), b = d/(8fB) for baseline B, focal length f (px),
/// disparity d at infinity.
struct DisparityLine {
  double a_per_m = 0;  ///< below 0
  double b_per_m = 0;  ///< above 0

  friend bool operator==(const DisparityLine&, const DisparityLine&) = default;
};

/// "camera" is the IR (depth) camera.
/// Paper: section III-A.
struct RgbdCalibration {
  PinholeCamera ir;
  PinholeCamera rgb;
  Eigen::Isometry3d T_rgb_ir = Eigen::Isometry3d::Identity();  ///< p_rgb = T_rgb_ir * p_ir, m
  std::optional<DisparityLine> disparity = std::nullopt;       ///< empty: kinect/disparity.h
  LensDistortion ir_lens = {}, rgb_lens = {};                  ///< the device's

  bool has_lens() const { return !(ir_lens.is_none() && rgb_lens.is_none()); }
  RgbdCalibration rectified() const {
    RgbdCalibration calibration = *this;
    calibration.ir_lens = calibration.rgb_lens = {};
    return calibration;
  }
};

RgbdCalibration synthetic_calibration();

/// IR f 575.816 px, RGB f 525 px, RGB camera 25 mm to the right. A real Kinect's colors are some pixels off.
RgbdCalibration nominal_kinect_calibration();

/// Reads {"version": 1, "ir": CAMERA, "rgb": CAMERA, "T_rgb_ir": {"rotation": 3 rows of 3, "translation_m": 3}},
/// CAMERA = {"width_px", "height_px", "fx_px", "fy_px", "cx_px", "cy_px"}. Optional: "disparity": {"a_per_m",
/// "b_per_m"}, and in CAMERA "distortion": {"k1", "k2", "p1", "p2", "k3"}.
/// Throws: Error unless numbers are finite, focal lengths > 0, sizes within kMostSide_px and kMostPixels, the
/// rotation right-handed and orthonormal (1e-6), a < 0, b > 0.
RgbdCalibration calibration_from_json(const nlohmann::json& json, const std::string& where);
RgbdCalibration calibration_from_text(std::string_view text, const std::string& where);
nlohmann::json to_json(const RgbdCalibration& calibration);

inline constexpr uint64_t kLargestCalibration = uint64_t{1} << 16;  // bytes

/// Reading it gives the same calibration bit for bit.
std::string calibration_text(const RgbdCalibration& calibration);
/// Throws: Error.
RgbdCalibration load_calibration(const std::string& path);
void save_calibration(const RgbdCalibration& calibration, const std::string& path);

}  // namespace glovebench
