#pragma once

#include "core/base/enum_names.h"

namespace glovebench {

/// How one motor moves the last two joints of a finger while nothing stands in their way. Its target is J0 = J1 +
/// J2, 0 to 180 degrees; J1 and J2 cannot be commanded apart (github.com/shadow-robot/sr_core, issue 150).
enum class ShadowCoupling {
  series,  ///< J2 alone until it is at 90 degrees, then J1: google-deepmind/mujoco_menagerie issue 132, one report
           ///< of a real hand, not verified against the maker's manual
  even,    ///< both alike, as published simulation models do
};
constexpr auto names_of(ShadowCoupling) {
  return std::to_array<std::string_view>({"series", "even"});
}

/// The last two joints of a finger, rad.
struct CoupledJoints {
  double distal;    ///< J1, which is never above J2
  double proximal;  ///< J2
};
/// The joints of a motor at `motor`, 0 to pi rad. Their sum is `motor`, to the last bit.
CoupledJoints split_motor(double motor, ShadowCoupling coupling);
/// J1's share of a small motion of the motor from there, 0 to 1; J2 has the rest.
double distal_share(double motor, ShadowCoupling coupling);

/// A share (0 to 1) of the way between two states of such joints. The motor goes straight. What the first state is
/// off the model, as a finger that touches something is, fades by the same share. Both joints stay within their
/// limits and J1 stays under J2.
CoupledJoints between(const CoupledJoints& from, const CoupledJoints& to, double share, ShadowCoupling coupling);

}  // namespace glovebench
