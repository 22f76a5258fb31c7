#include "reports/metrics/measure_frame.h"

namespace glovebench::reports {
namespace {

std::optional<double> matching_error_px(const TrackResult& estimate, const FrameTruth&) {
  if (estimate.matches.empty()) return {};
  return estimate.matches[0].error;
}

std::optional<double> icp_residual_mm(const MeasuredFrame& frame) {
  if (frame.estimate.icp_points == 0) return {};
  return 1000 * frame.estimate.icp_residual;
}

}  // namespace

std::vector<Metric> alignment_metrics() {
  return {{.key = "matching_error_px",
           .unit = "px",
           .description = "equation (2) of the best match",
           .formula = "sum over glove pixels a of min over pixels b of its color of |a - b|, / glove pixels",
           .place = 130,
           .of_any = matching_error_px},
          // Quality of the fit, not an error against the truth. It rises first when the sensor gets noisier or an
          // alignment stops too early.
          {.key = "icp_residual_mm",
           .unit = "mm",
           .description = "mean distance of the points from the aligned mesh",
           .formula = "sum over the n points of the distance to the closest triangle of their color, / n",
           .place = 140,
           .gate = Metric::Gate{0.1, 0.01},
           .of_tracked = icp_residual_mm,
           .needs = Needs::internals,
           .is_partial = true}};
}

}  // namespace glovebench::reports
