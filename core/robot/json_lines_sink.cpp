#include "core/robot/json_lines_sink.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/math.h"

namespace glovebench {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double value, std::string_view field) {
  if (!std::isfinite(value))
    throw Error("robot command", std::string(field), fmt::format("{}", value), "a finite number");
  return std::round(value * 1e6) / 1e6 + 0.0;  // + 0.0 turns -0 into 0
}

template <typename Infos, typename Values>
Json angles_json(const Infos& infos, const Values& values) {
  Json angles = Json::object();
  for (size_t i = 0; i < infos.size(); ++i) {
    const std::string name(infos[i].name);
    angles[name] = rounded(degrees_from_radians(values[i]), name);
  }
  return angles;
}

template <typename Infos, typename Values, typename Flags>
Json targets_json(const Infos& infos, const Values& values, const Flags& clamped) {
  Json names = Json::array();
  for (size_t i = 0; i < infos.size(); ++i)
    if (clamped[i]) names.push_back(std::string(infos[i].name));
  return {{"target_deg", angles_json(infos, values)}, {"clamped", std::move(names)}};
}

Json interventions_json(const Interventions& interventions) {
  Json counts = Json::object();
  for (const Intervention kind : all_values<Intervention>())
    if (interventions[kind] > 0) counts[std::string(to_string(kind))] = interventions[kind];
  return counts;
}

Json pose_json(const Eigen::Isometry3d& T_base_hand) {
  Eigen::Quaterniond q(T_base_hand.linear());
  if (q.w() < 0) q.coeffs() = -q.coeffs();  // q and -q are one rotation: write one of them
  const Eigen::Vector3d p = T_base_hand.translation();
  Json position = Json::array(), rotation = Json::array();
  for (const double value : {p.x(), p.y(), p.z()}) position.push_back(rounded(value, "position_m"));
  for (const double value : {q.w(), q.x(), q.y(), q.z()}) rotation.push_back(rounded(value, "rotation_wxyz"));
  return {{"position_m", std::move(position)}, {"rotation_wxyz", std::move(rotation)}};
}

}  // namespace

std::string to_json_line(const RobotCommand& command) {
  Json line = {{"frame_timestamp_us", command.frame_timestamp_us},
               {"timestamp_us", command.timestamp_us},
               {"status", std::string(to_string(command.status))},
               {"hold", command.hold},
               {"state", std::string(to_string(command.state))},
               {"interventions", interventions_json(command.interventions)},
               {"actuators", nullptr},
               {"joints", nullptr},
               {"base_hand", nullptr},
               {"arm", nullptr}};
  if (command.targets) {
    const ShadowHandTargets& hand = command.targets->hand;
    line["actuators"] = targets_json(shadow_actuator_infos(), hand.actuators, hand.actuator_clamped);
    line["joints"] = targets_json(shadow_joint_infos(), hand.joints, hand.joint_clamped);
    line["base_hand"] = pose_json(command.targets->T_base_hand);
    if (command.targets->arm) line["arm"] = {{"target_deg", angles_json(arm_joint_infos(), *command.targets->arm)}};
  }
  return line.dump();
}

void JsonLinesSink::send(const RobotCommand& command) {
  file_.append(to_json_line(command));
}

}  // namespace glovebench
