#include "reports/metrics/measure_frame.h"
#include "reports/statistics.h"

namespace glovebench::reports {
namespace {

/// (|w' - w| + |k1' - k1| + ... + |k4' - k4|) / 5 for the wrist w and the knuckles k1 to k4, the MCP joints of
/// index to little finger. The palm carries these five rigidly; the thumb's joints move with the thumb.
std::optional<double> palm_error_mm(const MeasuredFrame& frame) {
  std::vector<double> errors = {frame.joint_errors_mm[kWristJoint]};
  for (const int joint : {6, 11, 16, 21}) errors.push_back(frame.joint_errors_mm[joint]);
  return mean(errors);
}

}  // namespace

std::vector<Metric> palm_metrics() {
  return {{.key = "palm_error_mm",
           .unit = "mm",
           .description = "mean distance of the wrist and the four knuckles (MCP joints): the pose of the palm",
           .formula = "(|w' - w| + sum over the knuckles of |k'_i - k_i|) / 5",
           .heading = "palm mm",
           .of_tracked = palm_error_mm}};
}

}  // namespace glovebench::reports
