#include "core/robot/robot_command.h"

#include "core/base/error.h"

namespace glovebench {
namespace {

void require_rigid(const Eigen::Isometry3d& T, const char* name) {
  const Eigen::Matrix3d R = T.linear();
  // 1e-6 admits a matrix that was written with seven digits.
  const bool rotation = R.allFinite() && R.isUnitary(1e-6) && R.determinant() > 0;
  if (!rotation || !T.translation().allFinite())
    throw Error("robot", name, "no rigid transform", "a finite translation and a rotation matrix");
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

}  // namespace glovebench
