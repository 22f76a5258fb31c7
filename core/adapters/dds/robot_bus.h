#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/adapters/dds/dds_access.h"
#include "core/robot/command_guard.h"
#include "core/robot/robot_command.h"

namespace glovebench {

/// To whom commands are sent.
struct RobotBusOptions {
  int domain = 0;  ///< 0..230
  DdsAccess access;
  /// To a robot's own controllers instead of `robot-server`: nobody else may write on their topics, and each motion
  /// starts where the robot is measured to stand.
  bool to_controller = false;
  bool arm = true;                                              ///< whether a controller's arm is spoken to
  Eigen::Isometry3d T_flange_wrist = default_T_flange_wrist();  ///< how the hand is mounted on it
  double longest_step_s = CommandLimits().longest_step_s;       ///< of the guard of the commands
};

/// Sends the commands of one sender over the robot's middleware. Every function throws Error.
class RobotBus {
 public:
  virtual ~RobotBus() = default;

  /// Joints of the arm at the start, rad. Empty unless the options ask for a controller's arm.
  virtual std::optional<ArmJoints> arm_start() const = 0;
  /// The time of a command by the clock of the wall, microseconds: the first frame's time stamp plus what has
  /// passed since then. Tells the guard where the robot stands if the command begins a motion on a controller's
  /// topics.
  virtual int64_t start(CommandGuard& guard, const RobotCommand& command) = 0;
  /// Sends a command that the guard let pass. `arrived_us`: when its frame was there, microseconds since 1970.
  virtual void send(const RobotCommand& safe, int64_t arrived_us) = 0;
  /// Waits until those who listen have everything, at most a second.
  virtual void finish() = 0;
};

/// Whether this build has Cyclone DDS.
extern const bool kHasDds;

/// For a controller's topics, waits some seconds for a measured state. Throws Error if there is none, for a domain
/// or network that is none, or if this build has no Cyclone DDS.
std::unique_ptr<RobotBus> join_robot_bus(const RobotBusOptions& options);

}  // namespace glovebench
