#pragma once

#include "core/robot/command_guard.h"
#include "core/robot/server/command_messages.h"
#include "core/robot/server/command_stream.h"
#include "core/robot/server/robot_state.h"
#include "core/robot/server/start_place.h"
#include "core/robot/server/stated_interval.h"

namespace glovebench {

/// The arm's side of the stream, as HandServer is the hand's. CommandGuard lets the pose of the hand move no faster
/// than a hand may; the joints follow it by inverse kinematics, each no faster than it may, and all of them no
/// faster than lets the hand keep its speeds on their way, which is not the pose's when they have to catch up: then
/// they go straight wherever their way would take the wrist out of the workspace.
/// Where the arm has no joints for a pose they stay, which is counted as `arm_unreachable`.
/// What the fingers do is not known here. So the wrist stays kShadowWristReach inside the workspace on all sides,
/// and moves and turns only as fast as every point within that reach may, as a fingertip.
class ArmServer {
 public:
  /// `solver` must outlive the server; `T_flange_wrist` is how the hand's forearm is mounted; `start`: where the
  /// joints stand. Throws Error unless they are within the limits and the wrist is in the workspace there
  /// (start_place.h), or if the limits have problems.
  ArmServer(const CommandLimits& limits, const ArmSolver& solver, const Eigen::Isometry3d& T_flange_wrist,
            const StartPlace& start);
  /// What the joints can do under these limits.
  static std::vector<JointMotion> joint_motions(const CommandLimits& limits);

  Receipt receive(const ros::PoseStamped& message, const Arrival& arrival);
  /// What the joints shall do now. Later than the last tick. `may_move`: false holds them.
  RobotState tick(const ServerTime& now, bool may_move = true);
  /// rad, from base to flange.
  std::vector<double> positions() const { return {joints_.begin(), joints_.end()}; }
  /// Where the wrist is, in the arm's base frame, if the joints do as they are told.
  Eigen::Isometry3d T_base_wrist() const { return wrist_pose(joints_); }

  CommandStream& stream() { return stream_; }
  const CommandStream& stream() const { return stream_; }
  const Interventions& interventions() const { return interventions_; }

 private:
  Eigen::Isometry3d wrist_pose(const ArmJoints& joints) const { return arm_flange_pose(joints) * T_flange_wrist_; }
  double outside(const ArmJoints& joints) const;
  ArmJoints step_towards(const Eigen::Isometry3d& T_base_wrist, double seconds);
  ArmJoints next_joints(const ArmJoints& wanted, double seconds);

  const ArmSolver& solver_;
  Eigen::Isometry3d T_flange_wrist_;
  CommandGuard guard_;
  CommandLimits limits_;  ///< the guard's
  CommandStream stream_;
  Interventions interventions_;
  ArmJoints joints_{};
  std::optional<Eigen::Isometry3d> goal_;  ///< of the last message, while it is followed
  bool changed_ = false;                   ///< the goal, since the guard got it
  bool ticked_ = false;
  int64_t now_us_ = 0;
};

}  // namespace glovebench
