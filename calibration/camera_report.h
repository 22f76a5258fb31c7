#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "calibration/stereo_fit.h"

namespace glovebench::calibration {

/// What the fit is worth: errors of each view, standard deviations, what was left out and why. The keys are
/// documented in calibration/README.md.
nlohmann::json report_json(const StereoFit& fit, const Chessboard& board);
/// The same, short, as lines of Markdown.
std::string report_text(const StereoFit& fit);

}  // namespace glovebench::calibration
