#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "core/robot/arm.h"
#include "core/robot/command_state.h"
#include "core/robot/fingertip_mapping.h"
#include "core/tracker/track_result.h"

namespace glovebench {

/// Where the robot's hand shall be and what its joints shall do.
struct RobotTargets {
  ShadowHandTargets hand;
  Eigen::Isometry3d T_base_hand = Eigen::Isometry3d::Identity();  ///< in the arm's base frame, m
  std::optional<ArmJoints> arm;                                   ///< rad; empty where there is no ArmSolver
};

/// What is sent to hand and arm for one frame (section V).
struct RobotCommand {
  int64_t frame_timestamp_us = 0;  ///< of the frame that was tracked
  int64_t timestamp_us = 0;        ///< of the command: that of its frame, or what a guard was told
  TrackStatus status = TrackStatus::no_hand;
  bool hold = true;  ///< the frame is lost: the targets are those of the last tracked frame
  CommandState state = CommandState::stopped;
  std::optional<RobotTargets> targets;  ///< empty until a first frame was tracked
  Interventions interventions;          ///< since the last command
};

/// The camera of the synthetic setup in the arm's base frame (x ahead, y left, z up): 1.2 m above the base plane,
/// 0.9 m ahead of the shoulder, looking straight down, the top of its image away from the arm.
Eigen::Isometry3d default_T_base_camera();

/// Where the wrist's first joint (WRJ2) is on the flange: at the end of a forearm of 213 mm (Shadow's model) that
/// lies across the flange, along its y. In line with the arm it would make the arm's own wrist straight where the
/// hand points ahead, and there it winds up (core/robot/README.md).
Eigen::Isometry3d default_T_flange_wrist();

/// How a tracked hand becomes targets.
struct RobotSetup {
  Eigen::Isometry3d T_base_camera = default_T_base_camera();  ///< the tracker's frame in the arm's base frame
  std::optional<Skeleton> skeleton = {};  ///< of the tracked hand: fingertips are mapped; without it, angles
  ShadowCoupling coupling = ShadowCoupling::series;  ///< of J1 and J2 of the robot's fingers
  std::shared_ptr<const ArmSolver> arm = {};         ///< without it there are no joint angles of the arm
  ArmJoints arm_start = kArmAtRest;                  ///< where it stands before the first frame, rad
  Eigen::Isometry3d T_flange_wrist = default_T_flange_wrist();
};

/// Turns the tracker's answers into commands, in time order. A lost frame repeats the last targets and says so.
/// Where the arm cannot reach a pose its last joint angles are kept, and the command says so (`arm_unreachable`).
class RobotCommander {
 public:
  /// Throws Error unless the transforms are finite and rigid.
  explicit RobotCommander(const RobotSetup& setup = {});
  explicit RobotCommander(const Eigen::Isometry3d& T_base_camera)
      : RobotCommander(RobotSetup{.T_base_camera = T_base_camera}) {}
  /// Throws Error if a tracked posture or pose is not finite.
  RobotCommand command(const TrackResult& result);

 private:
  /// Empty while the arm has reached nothing.
  std::optional<ArmJoints> arm_joints(const RobotTargets& targets, Interventions& interventions);

  Eigen::Isometry3d T_base_camera_, T_wrist_flange_;
  ShadowCoupling coupling_;
  std::optional<FingertipMapping> fingertips_;
  std::optional<ArmFollower> arm_;
  std::optional<RobotTargets> last_;
};

/// Where commands go: a file here; a middleware, a simulation or a safety filter in front of one elsewhere.
class RobotCommandSink {
 public:
  virtual ~RobotCommandSink() = default;
  virtual void send(const RobotCommand& command) = 0;
  /// No more commands follow. Throws Error if what was sent could not be delivered.
  virtual void finish() = 0;
};

}  // namespace glovebench
