#include "reports/metrics/measure_frame.h"

namespace glovebench::reports {
namespace {

/// (|w' - w| + |k1' - k1| + ... + |k4' - k4|) / 5 for the wrist w and the knuckles k1 to k4, the MCP joints of
/// index to little finger. The palm carries these five rigidly; the thumb's joints move with the thumb.
std::optional<double> palm_error_mm(const MeasuredFrame& frame) {
  constexpr std::array<int, 5> kPalmJoints = {kWristJoint, 6, 11, 16, 21};
  return mean_error_mm(frame, kPalmJoints);
}

}  // namespace

std::vector<Metric> palm_metrics() {
  return {{.key = "palm_error_mm",
           .unit = "mm",
           .description = "mean distance of the wrist and the four knuckles (MCP joints): the pose of the palm",
           .formula = "(|w' - w| + sum over the knuckles of |k'_i - k_i|) / 5",
           .heading = "palm mm",
           .of_tracked = palm_error_mm,
           .needs = Needs::joints_in_camera}};
}

}  // namespace glovebench::reports
