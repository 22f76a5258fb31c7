#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/robot/robot_command.h"

namespace glovebench {

/// What a stream of commands may do. Where the joints lie is in `shadow_joint_infos` and `arm_joint_infos`.
struct CommandLimits {
  double hand_joint_speed = 2;   ///< of each joint of the hand, rad/s: a choice, within what Shadow's hands can do
  double hand_speed = 0.25;      ///< of the hand's origin, m/s: the number of ISO 10218-1's reduced speed
  double hand_turn_speed = 1.5;  ///< of its turning, rad/s
  double fingertip_speed = 0.5;  ///< of each fingertip, m/s: a choice, twice the hand's
  double arm_speed_share = 1;    ///< of the speeds in `arm_joint_infos`, 0..1
  /// Where the hand's origin and its fingertips may be in the arm's base frame, m. Each side is at least 0.3 m,
  /// twice `kShadowHandReach`.
  Eigen::Vector3d workspace_min{-1.5, -1.5, 0};
  Eigen::Vector3d workspace_max{1.5, 1.5, 2};
  double longest_step_s =
      0.1;                  ///< however long ago the last command was sent, nothing moves farther than in this time
  double silence_s = 0.15;  ///< without a command for longer than this: as if the hand was lost
  double stop_after_s = 0.5;  ///< lost or silent for longer than this: stopped. At least silence_s
  ShadowCoupling coupling = ShadowCoupling::series;  ///< of J1 and J2; not in the file of limits

  /// All that is wrong, one entry each; empty if nothing is.
  std::vector<std::string> problems() const;
};

/// The limits with the fields of a JSON object in place of the defaults; keys carry their units. `where` names the
/// object in errors. Throws Error for unknown keys, wrong kinds, and limits with problems.
CommandLimits command_limits_from_json(const nlohmann::json& json, const std::string& where);
/// All fields but the coupling, which is a flag of its own; command_limits_from_json reads them back.
nlohmann::json to_json(const CommandLimits& limits);

}  // namespace glovebench
