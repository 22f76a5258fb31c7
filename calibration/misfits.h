#pragma once

#include <string>
#include <vector>

#include "calibration/board_views.h"

namespace glovebench::calibration {

/// Views or pairs with a larger error (px) do not fit with the others: three times the median, but no less than
/// what a detector scatters by itself. `errors_px` must not be empty.
double misfit_limit(const std::vector<double>& errors_px);
LeftOut misfit(const std::string& name, double error_px, double limit_px);

}  // namespace glovebench::calibration
