#include "calibration/misfits.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/quantile.h"

namespace glovebench::calibration {

double misfit_limit(const std::vector<double>& errors_px) {
  constexpr double kTimesMedian = 3, kSmallest_px = 0.5;
  return std::max(kTimesMedian * quantile_of(errors_px, 0.5).value(), kSmallest_px);
}

void require_fit(double error_px, const std::string& where) {
  constexpr double kLargest_px = 2;
  if (!(error_px <= kLargest_px))
    throw Error(
        where, "error of the fit", fmt::format("{:.1f} px", error_px),
        fmt::format("at most {} px: sharp pictures of a flat board, of the size and in the pairs that are said",
                    kLargest_px));
}

LeftOut misfit(const std::string& name, double error_px, double limit_px) {
  return {name, fmt::format("does not fit with the others: {:.2f} px, of at most {:.2f} px", error_px, limit_px)};
}

}  // namespace glovebench::calibration
