#include "core/robot/shadow_coupling.h"

#include <algorithm>

#include "core/base/angles.h"

namespace glovebench {
namespace {

double right_angle() {
  return radians_from_degrees(90);
}

/// Not more than the other half, also of a number that cannot be halved.
double half(double motor) {
  return std::min(motor / 2, motor - motor / 2);
}

}  // namespace

CoupledJoints split_motor(double motor, ShadowCoupling coupling) {
  if (coupling == ShadowCoupling::even) return {half(motor), motor - half(motor)};
  // From 90 to 180 degrees the difference is exact, and so is the sum.
  return {std::max(motor - right_angle(), 0.0), std::min(motor, right_angle())};
}

double distal_share(double motor, ShadowCoupling coupling) {
  if (coupling == ShadowCoupling::even) return 0.5;
  return motor < right_angle() ? 0 : 1;
}

CoupledJoints between(const CoupledJoints& from, const CoupledJoints& to, double share, ShadowCoupling coupling) {
  const double start = from.distal + from.proximal, end = to.distal + to.proximal;
  const auto [lowest, highest] = std::minmax(start, end);
  const double motor = std::clamp(start + share * (end - start), lowest, highest);
  const double off_model = (1 - share) * (from.distal - split_motor(start, coupling).distal) +
                           share * (to.distal - split_motor(end, coupling).distal);
  const double distal = std::clamp(split_motor(motor, coupling).distal + off_model,
                                   std::max(motor - right_angle(), 0.0), half(motor));
  return {distal, motor - distal};
}

}  // namespace glovebench
