#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/camera/pinhole_camera.h"

namespace glovebench {

/// A Kinect's own depth, as calibrations give it: z = 1 / (a * raw + b), metres, of raw 11-bit disparity. With f
/// (px), baseline B (m), steps of 1/8 px and the disparity d at infinity, a = -1 / (8 f B) and b = d / (8 f B).
struct DisparityLine {
  double a_per_m = 0;  ///< below 0: the larger the disparity, the farther
  double b_per_m = 0;  ///< above 0

  friend bool operator==(const DisparityLine&, const DisparityLine&) = default;
};

/// What a stereo calibration of a Kinect gives (section III-A). The frame called "camera" everywhere else
/// is the IR (depth) camera.
struct RgbdCalibration {
  PinholeCamera ir;
  PinholeCamera rgb;
  Eigen::Isometry3d T_rgb_ir = Eigen::Isometry3d::Identity();  ///< p_rgb = T_rgb_ir * p_ir, metres
  std::optional<DisparityLine> disparity = std::nullopt;       ///< none: the driver's formula (kinect/disparity.h)
  LensDistortion ir_lens = {}, rgb_lens = {};                  ///< of the images as the device gives them

  bool has_lens() const { return !(ir_lens.is_none() && rgb_lens.is_none()); }
  /// Of rectified images (kinect/rectified_device.h), which are what a tracker takes.
  RgbdCalibration rectified() const {
    RgbdCalibration calibration = *this;
    calibration.ir_lens = calibration.rgb_lens = {};
    return calibration;
  }
};

/// The one self-consistent calibration of the synthetic Kinect: IR f 575.816 px, RGB f 525 px, principal points
/// near the center, baseline 24 mm, a rotation of under one degree.
RgbdCalibration synthetic_calibration();

/// A Kinect as it is built: IR f 575.816 px (the driver's formula), RGB f 525 px, principal points in the center,
/// the RGB camera 25 mm to the right of the IR camera, no rotation. Of one device colors are off by some pixels;
/// what tracks well has a calibration of its own.
RgbdCalibration nominal_kinect_calibration();

/// Reads {"version": 1, "ir": CAMERA, "rgb": CAMERA, "T_rgb_ir": {"rotation": 3 rows of 3, "translation_m": 3}}
/// with CAMERA = {"width_px", "height_px", "fx_px", "fy_px", "cx_px", "cy_px"}, and where there is one
/// "disparity": {"a_per_m", "b_per_m"} and in a CAMERA "distortion": {"k1", "k2", "p1", "p2", "k3"}. Every other
/// key is required and no more are allowed. Throws Error naming `where` and the field; numbers must be finite,
/// focal lengths positive, images no larger than kMostSide_px and kMostPixels, the rotation orthonormal (1e-6) and
/// right-handed, a below and b above 0.
RgbdCalibration calibration_from_json(const nlohmann::json& json, const std::string& where);
/// The same from what a file holds.
RgbdCalibration calibration_from_text(std::string_view text, const std::string& where);
nlohmann::json to_json(const RgbdCalibration& calibration);

inline constexpr uint64_t kLargestCalibration = uint64_t{1} << 16;  // bytes: fifty times ours

/// The content of a calibration file. It is read again bit for bit.
std::string calibration_text(const RgbdCalibration& calibration);
/// A calibration file. Both throw Error.
RgbdCalibration load_calibration(const std::string& path);
void save_calibration(const RgbdCalibration& calibration, const std::string& path);

}  // namespace glovebench
