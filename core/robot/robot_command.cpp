#include "core/robot/robot_command.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/math.h"

namespace glovebench {
namespace {

using Json = nlohmann::ordered_json;

void require_rigid(const Eigen::Isometry3d& T, const char* name) {
  const Eigen::Matrix3d R = T.linear();
  // 1e-6 admits a matrix that was written with seven digits.
  const bool rotation = R.allFinite() && R.isUnitary(1e-6) && R.determinant() > 0;
  if (!rotation || !T.translation().allFinite())
    throw Error("robot", name, "no rigid transform", "a finite translation and a rotation matrix");
}

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

Eigen::Isometry3d default_T_base_camera() {
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
  T_base_camera.linear() << 0, -1, 0,  // image rows run towards the arm
      -1, 0, 0,                        // image columns run to its right
      0, 0, -1;
  T_base_camera.translation() << 0.9, 0, 1.2;
  return T_base_camera;
}

Eigen::Isometry3d default_T_flange_wrist() {
  // Exact, so that a level hand has a level forearm.
  Eigen::Isometry3d T_flange_wrist = Eigen::Isometry3d::Identity();
  T_flange_wrist.linear() << 1, 0, 0,  //
      0, 0, 1,                         // along the flange's y
      0, -1, 0;                        // its back away from the flange, up
  T_flange_wrist.translation().y() = 0.213;
  return T_flange_wrist;
}

RobotCommander::RobotCommander(const RobotSetup& setup)
    : T_base_camera_(setup.T_base_camera),
      T_wrist_flange_(setup.T_flange_wrist.inverse()),
      coupling_(setup.coupling) {
  require_rigid(setup.T_base_camera, "T_base_camera");
  require_rigid(setup.T_flange_wrist, "T_flange_wrist");
  if (setup.skeleton) fingertips_.emplace(*setup.skeleton, setup.coupling);
  if (setup.arm) arm_.emplace(setup.arm, setup.arm_start);
}

std::optional<ArmJoints> RobotCommander::arm_joints(const RobotTargets& targets, Interventions& interventions) {
  if (!arm_) return std::nullopt;
  const Eigen::Isometry3d T_base_wrist = targets.T_base_hand * shadow_T_wrist_hand(targets.hand.joints).inverse();
  if (arm_->follow(T_base_wrist * T_wrist_flange_)) return arm_->joints();
  interventions.add(Intervention::arm_unreachable);
  return last_ ? last_->arm : std::nullopt;
}

RobotCommand RobotCommander::command(const TrackResult& result) {
  RobotCommand command;
  command.frame_timestamp_us = command.timestamp_us = result.timestamp_us;
  command.status = result.status;
  command.hold = result.status != TrackStatus::tracked;
  if (!command.hold) {
    if (!result.T_camera_hand.matrix().allFinite())
      throw Error("robot command", "T_camera_hand", "a value that is not finite", "a finite pose");
    RobotTargets targets{
        fingertips_ ? fingertips_->map(result.posture) : map_to_shadow_hand(result.posture, coupling_),
        T_base_camera_ * result.T_camera_hand, std::nullopt};
    targets.arm = arm_joints(targets, command.interventions);
    last_ = targets;
  }
  command.targets = last_;
  command.state = !command.hold ? CommandState::following : last_ ? CommandState::holding : CommandState::stopped;
  return command;
}

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

void JsonLinesSink::send(const RobotCommand& command) { file_.append(to_json_line(command)); }

}  // namespace glovebench
