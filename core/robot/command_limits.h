#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/robot/robot_command.h"

namespace glovebench {

struct CommandLimits {
  double hand_joint_speed = 2;   ///< rad/s
  double hand_speed = 0.25;      ///< m/s: ISO 10218-1's reduced speed
  double hand_turn_speed = 1.5;  ///< rad/s
  double fingertip_speed = 0.5;  ///< m/s
  double arm_speed_share = 1;    ///< of `arm_joint_infos`, 0..1
  /// For the hand's origin and fingertips; arm's base frame, m; sides >= 0.3 m.
  Eigen::Vector3d workspace_min{-1.5, -1.5, 0};
  Eigen::Vector3d workspace_max{1.5, 1.5, 2};
  /// The most time that a step counts for speed limits.
  double longest_step_s = 0.1;
  double silence_s = 0.15;                           ///< without commands for longer: holding
  double stop_after_s = 0.5;                         ///< lost or silent for longer: stopped; at least silence_s
  ShadowCoupling coupling = ShadowCoupling::series;  ///< not in the limits' file

  /// One line per problem.
  std::vector<std::string> problems() const;
};

/// Missing fields keep defaults.
/// Throws: Error for unknown keys, wrong kinds, and limits with problems.
CommandLimits command_limits_from_json(const nlohmann::json& json, const std::string& where);
/// All fields but the coupling.
nlohmann::json to_json(const CommandLimits& limits);

}  // namespace glovebench
