#include "reports/comparison/quantities.h"

#include "core/base/check.h"

namespace glovebench::reports {
namespace {

constexpr double kTolerance_mm = 0.01;
constexpr double kTolerance_deg = 0.01;
constexpr double kPercent = 100;

}  // namespace

const std::array<Quantity, kQuantityCount>& quantities() {
  // The defaults are about a fifteenth of the mean errors of Figure 4: what a reader of its table would notice.
  static constexpr std::array<Quantity, kQuantityCount> all = {{
      {"position_error_mm", "mm", false, 0.2, kTolerance_mm},
      {"rotation_error_deg", "deg", false, 0.3, kTolerance_deg},
      {"posture_rms_deg", "deg", false, 0.5, kTolerance_deg},
      {"posture_rms_unfiltered_deg", "deg", false, 0.5, kTolerance_deg},
      {"vertex_error_mm", "mm", false, 0.2, kTolerance_mm},
      {"fingertip_error_mm", "mm", false, 0.2, kTolerance_mm},
      // A share has no tolerance of its own: never less than two frames is the stricter bound.
      {"uncovered_percent", "%", true, 1, 0},
      {"false_tracked_percent", "%", true, 1, 0},
      {"false_lost_percent", "%", true, 1, 0},
      {"icp_residual_mm", "mm", false, 0.1, kTolerance_mm},
  }};
  return all;
}

std::optional<double> value_of(const Quantity& quantity, const FrameRecord& frame) {
  if (!quantity.is_share) return frame.*metrics()[metric_index(quantity.key)].value;
  if (quantity.key == "uncovered_percent") return frame.covered ? 0 : kPercent;
  if (quantity.key == "false_tracked_percent") return frame.false_tracked ? kPercent : 0;
  check(quantity.key == "false_lost_percent", "every share has a meaning");
  return frame.false_lost ? kPercent : 0;
}

}  // namespace glovebench::reports
