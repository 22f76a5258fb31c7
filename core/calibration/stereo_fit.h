#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/calibration/camera_fit.h"

namespace glovebench::calibration {

/// Both cameras of a Kinect.
struct StereoFit {
  CameraFit ir, rgb;                   ///< each alone, from all of its views
  RgbdCalibration calibration;         ///< of both together, from the pairs
  double error_px = 0;                 ///< RMS over the corners of both cameras in all pairs
  std::vector<std::string> pairs;      ///< names of the views that both cameras have
  std::vector<double> pair_errors_px;  ///< of each pair
  std::vector<LeftOut> left_out;       ///< pairs that do not fit: the board was moved between the two pictures
  /// Standard errors of the mean over pairs, each taken alone: how sure the transform is.
  double translation_error = 0;  ///< m
  double rotation_error = 0;     ///< rad
};

/// Fits each camera to its views; then both and the transform between them, T_rgb_ir, to views of the same name, on
/// which they have seen the board in the same place. Views of one camera alone help to find misfits. Throws Error:
/// see fit_camera; if fewer than five pairs fit, or none but by over 2 px; or if the two cameras lie farther apart,
/// or turned against each other more, than those of one device could.
StereoFit fit_stereo(const BoardViews& ir, const BoardViews& rgb, const Chessboard& board, LensModel lens);

/// The quality of the fit: errors of each view, standard deviations, what was left out and why. The keys are
/// documented in README.md.
nlohmann::json report_json(const StereoFit& fit, const Chessboard& board);
/// The same, short, as lines of Markdown.
std::string report_text(const StereoFit& fit);

}  // namespace glovebench::calibration
