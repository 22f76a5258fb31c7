#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>

#include "core/base/line_file.h"
#include "core/robot/arm.h"
#include "core/robot/command_state.h"
#include "core/robot/fingertip_mapping.h"
#include "core/tracker/track_result.h"

namespace glovebench {

struct RobotTargets {
  ShadowHandTargets hand;
  Eigen::Isometry3d T_base_hand = Eigen::Isometry3d::Identity();  ///< m
  std::optional<ArmJoints> arm;                                   ///< rad; empty without ArmSolver
};

/// Paper: section V.
struct RobotCommand {
  int64_t frame_timestamp_us = 0;
  int64_t timestamp_us = 0;  ///< of the frame, or the guard's time
  TrackStatus status = TrackStatus::no_hand;
  bool hold = true;  ///< the frame is lost; the last targets repeat
  CommandState state = CommandState::stopped;
  std::optional<RobotTargets> targets;  ///< empty before the first tracked frame
  Interventions interventions;          ///< since the last command
};

/// The synthetic camera (core/robot/README.md). The image's top points away from the arm.
Eigen::Isometry3d default_T_base_camera();

/// The forearm lies across the flange (core/robot/README.md).
Eigen::Isometry3d default_T_flange_wrist();

struct RobotSetup {
  Eigen::Isometry3d T_base_camera = default_T_base_camera();
  std::optional<Skeleton> skeleton = {};  ///< empty: mapping `direct`
  ShadowCoupling coupling = ShadowCoupling::series;
  std::shared_ptr<const ArmSolver> arm = {};
  ArmJoints arm_start = kArmAtRest;  ///< before the first frame, rad
  Eigen::Isometry3d T_flange_wrist = default_T_flange_wrist();
};

/// Turns track results into commands, in time order. A lost frame repeats the last targets. An unreachable pose
/// keeps the arm's joints.
class RobotCommander {
 public:
  /// Throws: Error unless the transforms are finite and rigid.
  explicit RobotCommander(const RobotSetup& setup = {});
  explicit RobotCommander(const Eigen::Isometry3d& T_base_camera)
      : RobotCommander(RobotSetup{.T_base_camera = T_base_camera}) {}
  /// Throws: Error if a tracked posture or pose is not finite.
  RobotCommand command(const TrackResult& result);

 private:
  /// Empty until the arm reaches a pose.
  std::optional<ArmJoints> arm_joints(const RobotTargets& targets, Interventions& interventions);

  Eigen::Isometry3d T_base_camera_, T_wrist_flange_;
  ShadowCoupling coupling_;
  std::optional<FingertipMapping> fingertips_;
  std::optional<ArmFollower> arm_;
  std::optional<RobotTargets> last_;
};

class RobotCommandSink {
 public:
  virtual ~RobotCommandSink() = default;
  virtual void send(const RobotCommand& command) = 0;
  /// Throws: Error if commands could not be delivered.
  virtual void finish() = 0;
};

/// JSON (core/robot/command.schema.json) without line end, rounded to 1e-6 of each unit.
/// Throws: Error if a number is not finite.
std::string to_json_line(const RobotCommand& command);

/// Writes to a LineFile.
/// Throws: Error, from every function, if the disk is full.
class JsonLinesSink : public RobotCommandSink {
 public:
  explicit JsonLinesSink(const std::string& path) : file_(path) {}
  void send(const RobotCommand& command) override;
  void finish() override { file_.finish(); }
  std::string kept() const { return file_.kept(); }

 private:
  LineFile file_;
};

}  // namespace glovebench
