#pragma once

#include <string>
#include <vector>

#include "core/hand/skeleton.h"
#include "core/robot/shadow_hand.h"
#include "reports/table.h"

namespace glovebench::eval {

/// A mapping's fingertip errors, hand frame.
/// Units: m; `largest_step` rad.
struct MappingErrors {
  int postures = 0;
  std::array<double, 5> tip_mean{}, tip_max{};  ///< thumb to little
  int pinches = 0;                              ///< thumb and finger within `kPinch`
  double gap_mean = 0, gap_max = 0;             ///< |robot's gap - human's|; 0 without pinches
  double largest_step = 0;                      ///< of a joint, between successive postures
};
inline constexpr double kPinch = 0.02;  ///< m; fingertips (bone ends) this near touch

using Mapping = std::function<ShadowHandTargets(const Posture&)>;
/// Right hand; at least one posture.
MappingErrors mapping_errors(const Skeleton& skeleton, const std::vector<Posture>& postures, const Mapping& map);

/// Both mappings on all posture sets and source trajectories.
reports::Table mapping_table(const Skeleton& skeleton, const std::string& data_folder, ShadowCoupling coupling);

}  // namespace glovebench::eval
