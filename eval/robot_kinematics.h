#pragma once

#include <string>
#include <vector>

#include "core/hand/skeleton.h"
#include "core/robot/shadow_kinematics.h"

namespace glovebench::eval {

/// How far the robot's fingertips are from the human ones, in the hand frame, over some postures in their order.
struct MappingErrors {
  int postures = 0;
  std::array<double, 5> tip_mean{}, tip_max{};  ///< of each fingertip, thumb to little, m
  int pinches = 0;                              ///< pairs of thumb and finger closer than `kPinch`
  double gap_mean = 0, gap_max = 0;  ///< of pinches, |robot's distance - human's|, m; 0 if there are none
  double largest_step = 0;           ///< of a joint from one posture to the next, rad
};
inline constexpr double kPinch = 0.02;  ///< fingertips closer than this touch: they are ends of bones, m

using Mapping = std::function<ShadowHandTargets(const Posture&)>;
/// Of a right hand. At least one posture.
MappingErrors mapping_errors(const Skeleton& skeleton, const std::vector<Posture>& postures, const Mapping& map);

/// For every posture set and source trajectory of the program, by the direct mapping and by fingertips, for a robot
/// with that coupling: the table of `glovebench list mapping`.
std::string mapping_table(const Skeleton& skeleton, const std::string& data_folder, ShadowCoupling coupling);

}  // namespace glovebench::eval
