#include "core/robot/command_limits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/excerpt.h"

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

void read_limit(double& value, const json& found, const std::string& where, const std::string& field) {
  if (!found.is_number()) throw Error(where, field, excerpt(found), "a number");
  value = found;
}
void read_limit(Eigen::Vector3d& value, const json& found, const std::string& where, const std::string& field) {
  if (!found.is_array() || found.size() != 3) throw Error(where, field, excerpt(found), "x, y and z");
  for (size_t i = 0; i < 3; ++i)
    read_limit(value[static_cast<int>(i)], found[i], where, fmt::format("{}[{}]", field, i));
}

json written_limit(double value) {
  return value;
}
json written_limit(const Eigen::Vector3d& value) {
  return {value.x(), value.y(), value.z()};
}

}  // namespace

CommandLimits command_limits_from_json(const json& j, const std::string& where) {
  if (!j.is_object()) throw Error(where, "limits", excerpt(j), "an object");
  CommandLimits limits;
  std::vector<std::string> keys;
  visit_fields(limits, [&](const char* key, auto& value) {
    keys.emplace_back(key);
    if (j.contains(key)) read_limit(value, j[key], where, key);
  });
  for (const auto& [key, unused] : j.items())
    if (std::ranges::find(keys, key) == keys.end())
      throw Error(where, excerpt(key), "an unknown key", fmt::format("one of {}", fmt::join(keys, ", ")));
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
