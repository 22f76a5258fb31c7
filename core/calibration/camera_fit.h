#pragma once

#include <string>
#include <vector>

#include "core/calibration/board_views.h"
#include "core/camera/rgbd_calibration.h"

namespace glovebench::calibration {

/// Largest error of a kept view or pair: three times the median, at least 0.5 px. `errors_px` must not be empty.
double misfit_limit(const std::vector<double>& errors_px);
/// Throws: Error if the RMS error exceeds 2 px.
void require_fit(double error_px, const std::string& where);
LeftOut misfit(const std::string& name, double error_px, double limit_px);

/// The fitted coefficients of LensDistortion: none; k1, k2, k3; all five.
enum class LensModel { none, radial, full };
constexpr auto names_of(LensModel) { return std::to_array<std::string_view>({"none", "radial", "full"}); }

/// Errors are RMS distances of corners from fitted ones.
struct CameraFit {
  PinholeCamera camera;
  LensDistortion lens;
  PinholeCamera deviation;  ///< standard deviations of fx, fy, cx, cy, px
  double error_px = 0;
  std::vector<BoardView> views;
  std::vector<double> view_errors_px;
  int tilted = 0;  ///< by over 10 degrees
  std::vector<LeftOut> left_out;
};

/// Zhang's method (OpenCV), without views beyond misfit_limit.
/// Throws: Error for too few or too similar views, or a bad fit (require_fit).
CameraFit fit_camera(const BoardViews& boards, const Chessboard& board, LensModel lens, const std::string& where);

}  // namespace glovebench::calibration
