#pragma once

#include <string>
#include <vector>

#include "calibration/board_views.h"

namespace glovebench::calibration {

/// Views or pairs with a larger error (px) do not fit with the others: three times the median, but no less than
/// what a detector scatters by itself. `errors_px` must not be empty.
double misfit_limit(const std::vector<double>& errors_px);
/// Throws Error naming `where` if an RMS error is larger than any fit to sharp pictures of one board leaves: half
/// of the views being wrong, none stands out.
void require_fit(double error_px, const std::string& where);
LeftOut misfit(const std::string& name, double error_px, double limit_px);

}  // namespace glovebench::calibration
