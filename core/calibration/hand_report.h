#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/calibration/hand_fit.h"
#include "core/hand/hand_file.h"

namespace glovebench::calibration {

/// A fit as it goes to the file.
MeasuredHand measured_hand(const HandFit& fit, Side side);

/// What the recording does not show, and what speaks against the fit. A sentence each.
std::vector<std::string> hand_warnings(const HandFit& fit, const ShownMotion& motion);

/// The report as JSON (README.md lists the keys), and as Markdown.
nlohmann::ordered_json hand_report_json(const HandFit& fit, const ShownMotion& motion,
                                        const std::string& recording);
std::string hand_report_markdown(const HandFit& fit, const ShownMotion& motion);

}  // namespace glovebench::calibration
