#include "core/base/math.h"
#include "reports/metrics/measure_frame.h"

namespace glovebench::reports {
namespace {

std::optional<double> position_error_mm(const MeasuredFrame& frame) {
  return 1000 * (frame.estimate.T_camera_hand.translation() - frame.truth.T_camera_hand.translation()).norm();
}

std::optional<double> rotation_error_deg(const MeasuredFrame& frame) {
  return degrees_from_radians(
      angle_between(frame.estimate.T_camera_hand.linear(), frame.truth.T_camera_hand.linear()));
}

}  // namespace

std::vector<Metric> pose_metrics() {
  return {{.key = "position_error_mm",
           .unit = "mm",
           .description = "distance of the hand origins",
           .formula = "|p' - p|, p the origin of the hand",
           .place = 10,
           .gate = Metric::Gate{0.2, 0.01},
           .of_tracked = position_error_mm,
           .needs = Needs::pose},
          {.key = "rotation_error_deg",
           .unit = "deg",
           .description = "geodesic angle between the hands",
           .formula = "angle of R'^T R",
           .place = 20,
           .gate = Metric::Gate{0.3, 0.01},
           .of_tracked = rotation_error_deg,
           .needs = Needs::pose}};
}

}  // namespace glovebench::reports
