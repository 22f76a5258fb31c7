#include "core/robot/command_limits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/base/json_cursor.h"

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

void read_limit(double& value, const JsonCursor& json) {
  value = json.number();
}
void read_limit(Eigen::Vector3d& value, const JsonCursor& json) {
  value = json.vector3();
}

json written_limit(double value) {
  return value;
}
json written_limit(const Eigen::Vector3d& value) {
  return {value.x(), value.y(), value.z()};
}

}  // namespace

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
