#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/calibration/camera_fit.h"

namespace glovebench::calibration {

struct StereoFit {
  CameraFit ir, rgb;
  RgbdCalibration calibration;
  double error_px = 0;  ///< RMS of all corners
  std::vector<std::string> pairs;
  std::vector<double> pair_errors_px;
  std::vector<LeftOut> left_out;
  /// Standard errors of T_rgb_ir.
  double translation_error = 0;  ///< m
  double rotation_error = 0;     ///< rad
};

/// Fits each camera alone, then both to views of the same name, which must show the board in one place.
/// Throws: Error as fit_camera, and for too few fitting pairs, or T_rgb_ir too large for one device.
StereoFit fit_stereo(const BoardViews& ir, const BoardViews& rgb, const Chessboard& board, LensModel lens);

/// README.md lists the keys.
nlohmann::json report_json(const StereoFit& fit, const Chessboard& board);
std::string report_text(const StereoFit& fit);

}  // namespace glovebench::calibration
