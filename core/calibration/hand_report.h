#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/calibration/hand_fit.h"
#include "core/hand/hand_file.h"

namespace glovebench::calibration {

MeasuredHand measured_hand(const HandFit& fit, Side side);

/// One sentence per size that the recording hides and per sign of a bad fit.
std::vector<std::string> hand_warnings(const HandFit& fit, const ShownMotion& motion);

/// README.md lists the keys.
nlohmann::ordered_json hand_report_json(const HandFit& fit, const ShownMotion& motion,
                                        const std::string& recording);
std::string hand_report_markdown(const HandFit& fit, const ShownMotion& motion);

}  // namespace glovebench::calibration
