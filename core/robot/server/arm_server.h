#pragma once

#include "core/robot/command_guard.h"
#include "core/robot/server/command_messages.h"
#include "core/robot/server/robot_state.h"
#include "core/robot/server/stream_gate.h"

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
  /// joints stand, rad, and `source` who says so. Throws Error unless they are within the limits and the wrist is
  /// in the workspace there (start_place.h), or if the limits have problems.
  ArmServer(const CommandLimits& limits, const ArmSolver& solver, const Eigen::Isometry3d& T_flange_wrist,
            const std::vector<double>& start, const std::string& source = "arm server");

  /// Whether a message of that sender is foreign, whatever is in it; then it is counted and need not be read.
  bool ignores(uint64_t sender, int64_t now_us);
  /// `now_us` is the server's own clock, as in `tick`. It must not go back.
  Receipt receive(uint64_t sender, const ros::PoseStamped& message, int64_t now_us);
  /// What the joints shall do now. Later than the last tick.
  RobotState tick(int64_t now_us);
  /// Where the wrist is, in the arm's base frame, if the joints do as they are told.
  Eigen::Isometry3d T_base_wrist() const { return wrist_pose(joints_); }

  StreamGate& gate() { return gate_; }
  const StreamGate& gate() const { return gate_; }
  const ReceiptCounts& receipts() const { return receipts_; }
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
  StreamGate gate_;
  ReceiptCounts receipts_{};
  Interventions interventions_;
  ArmJoints joints_{};
  std::optional<Eigen::Isometry3d> goal_;  ///< received since the last tick
  bool ticked_ = false;
  int64_t now_us_ = 0;
};

}  // namespace glovebench
