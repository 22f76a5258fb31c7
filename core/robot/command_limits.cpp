#include "core/robot/command_limits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/base/json_cursor.h"
#include "core/robot/shadow_kinematics.h"

namespace glovebench {
namespace {

using nlohmann::json;

/// Every limit, once: reading and writing go through here.
template <typename Limits, typename Visit>
void visit_fields(Limits& limits, Visit&& visit) {
  visit("hand_joint_speed_rad_s", limits.hand_joint_speed);
  visit("hand_speed_m_s", limits.hand_speed);
  visit("hand_turn_speed_rad_s", limits.hand_turn_speed);
  visit("fingertip_speed_m_s", limits.fingertip_speed);
  visit("arm_speed_share", limits.arm_speed_share);
  visit("workspace_min_m", limits.workspace_min);
  visit("workspace_max_m", limits.workspace_max);
  visit("longest_step_s", limits.longest_step_s);
  visit("silence_s", limits.silence_s);
  visit("stop_after_s", limits.stop_after_s);
}

void read_limit(double& value, const JsonCursor& json) { value = json.number(); }
void read_limit(Eigen::Vector3d& value, const JsonCursor& json) { value = json.vector3(); }

json written_limit(double value) { return value; }
json written_limit(const Eigen::Vector3d& value) { return {value.x(), value.y(), value.z()}; }

}  // namespace

std::vector<std::string> CommandLimits::problems() const {
  std::vector<std::string> problems;
  const auto require = [&](bool fine, const char* what) {
    if (!fine) problems.emplace_back(what);
  };
  const auto require_up_to = [&](double most, double value, const char* key) {
    if (!(value > 0 && value <= most))
      problems.push_back(fmt::format("{}: found {}, expected above 0 and at most {}", key, value, most));
  };
  constexpr double kFastest = 10, kFastestTurn = 100;  // m/s and rad/s: no such robot is as fast
  require_up_to(kFastestTurn, hand_joint_speed, "hand_joint_speed_rad_s");
  require_up_to(kFastest, hand_speed, "hand_speed_m_s");
  require_up_to(kFastestTurn, hand_turn_speed, "hand_turn_speed_rad_s");
  require_up_to(kFastest, fingertip_speed, "fingertip_speed_m_s");
  require_up_to(1, arm_speed_share, "arm_speed_share");
  require(workspace_min.allFinite() && workspace_max.allFinite() &&
              (workspace_min.array() <= workspace_max.array()).all(),
          "the workspace is empty");
  require(!((workspace_max - workspace_min).minCoeff() < 2 * kShadowHandReach),
          "a side of the workspace is shorter than 0.3 m, twice the reach of fingertips about the hand's origin");
  constexpr double kLongestStep = 2, kLongestWait = 60;
  require_up_to(kLongestStep, longest_step_s, "longest_step_s");
  require_up_to(kLongestWait, silence_s, "silence_s");
  if (!(stop_after_s >= silence_s && stop_after_s <= kLongestWait))
    problems.push_back(fmt::format("stop_after_s: found {}, expected silence_s to {}", stop_after_s, kLongestWait));
  return problems;
}

CommandLimits command_limits_from_json(const json& j, const std::string& where) {
  const JsonCursor root(j, where);
  CommandLimits limits;
  std::vector<std::string_view> keys;
  visit_fields(limits, [&](const char* key, auto& value) {
    keys.emplace_back(key);
    if (root.has(key)) read_limit(value, root[key]);
  });
  root.expect_keys({}, keys);
  if (const std::vector<std::string> problems = limits.problems(); !problems.empty())
    throw Error(fmt::format("{}: {}", where, fmt::join(problems, "; ")));
  return limits;
}

json to_json(const CommandLimits& limits) {
  json j;
  visit_fields(limits, [&](const char* key, const auto& value) { j[key] = written_limit(value); });
  return j;
}

}  // namespace glovebench
