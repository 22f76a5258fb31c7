#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/adapters/dds/dds_access.h"
#include "core/robot/command_guard.h"
#include "core/robot/robot_command.h"

namespace glovebench {

struct RobotBusOptions {
  int domain = 0;  ///< 0..230
  DdsAccess access;
  /// Commands go to controllers, not to `robot-server`.
  bool to_controller = false;
  bool arm = true;  ///< command the controller's arm
  Eigen::Isometry3d T_flange_wrist = default_T_flange_wrist();
  double longest_step_s = CommandLimits().longest_step_s;  ///< of the commands' guard
};

/// Sends commands over DDS.
/// Throws: Error from every function.
class RobotBus {
 public:
  virtual ~RobotBus() = default;

  /// The arm's joints, rad. Empty unless a controller's arm is commanded.
  virtual std::optional<ArmJoints> arm_start() const = 0;
  /// Returns the command's time, us: the first frame's time stamp plus the time since. With a controller, first
  /// calls the guard's `start_from`.
  virtual int64_t start(CommandGuard& guard, const RobotCommand& command) = 0;
  /// `arrived_us`: when the frame was complete, since 1970.
  virtual void send(const RobotCommand& safe, int64_t arrived_us) = 0;
  /// Waits up to 1 s until listeners have all messages.
  virtual void finish() = 0;
};

extern const bool kHasDds;

/// Throws: Error without Cyclone DDS, if domain or network is unusable, or if `to_controller` gets no measured
/// state in some seconds.
std::unique_ptr<RobotBus> join_robot_bus(const RobotBusOptions& options);

}  // namespace glovebench
