#pragma once

#include <string>
#include <vector>

#include "core/calibration/board_views.h"
#include "core/camera/rgbd_calibration.h"

namespace glovebench::calibration {

/// Views or pairs with a larger error (px) do not fit with the others: three times the median, but no less than
/// what a detector scatters by itself. `errors_px` must not be empty.
double misfit_limit(const std::vector<double>& errors_px);
/// Throws Error naming `where` if an RMS error is larger than any fit to sharp pictures of one board leaves: half
/// of the views being wrong, none stands out.
void require_fit(double error_px, const std::string& where);
LeftOut misfit(const std::string& name, double error_px, double limit_px);

/// Which coefficients of LensDistortion are fitted; the others are zero.
enum class LensModel { none, radial, full };  ///< nothing; k1, k2, k3; all five
constexpr auto names_of(LensModel) {
  return std::to_array<std::string_view>({"none", "radial", "full"});
}

/// One camera. Errors are distances between corners as they were seen and as the fit says, RMS over corners, px.
struct CameraFit {
  PinholeCamera camera;
  LensDistortion lens;
  PinholeCamera deviation;  ///< standard deviations of fx, fy, cx, cy, px, if corners err by chance alone
  double error_px = 0;
  std::vector<BoardView> views;  ///< those that were used
  std::vector<double> view_errors_px;
  int tilted = 0;                 ///< of the views, boards turned from the camera by more than 10 degrees
  std::vector<LeftOut> left_out;  ///< those that were not
};

/// Fits a camera to views of a board by Zhang's method (OpenCV). A view whose error is three times the median's is
/// left out, and the rest fitted again. Throws Error naming `where` if fewer than five views are left, or if they
/// do not tell the focal length: fewer than three boards are tilted, or its standard deviation is over 5%.
CameraFit fit_camera(const BoardViews& views, const Chessboard& board, LensModel lens, const std::string& where);

}  // namespace glovebench::calibration
