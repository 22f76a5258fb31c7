#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <string>

#include "core/robot/command_guard.h"
#include "core/robot/dds/dds_access.h"
#include "core/robot/server/server_log.h"

namespace glovebench {

struct DdsServerOptions {
  int domain = 0;
  DdsAccess access;
  /// File to append the log to, which also says where the joints stood when the last server ended; empty: none.
  std::string log;
  /// How long ago that may be: after longer than that, somebody may have moved them.
  double max_log_age_s = kMaxLogAge;
  CommandLimits limits;
  std::function<bool()> stopping;  ///< asked a hundred times a second; true ends the server
  /// What a person should know at once, a line each.
  std::function<void(const std::string&)> tell = [](const std::string&) {};
};

/// What a server did.
struct DdsServerSummary {
  std::string text;            ///< one line
  int64_t lost_log_lines = 0;  ///< that could not be written
};

/// Serves the hand (`HandServer`) or the arm (`ArmServer`) over DDS until it shall stop: takes commands, and a
/// hundred times a second sends where the joints shall be as their state, `sensor_msgs/JointState`. The joints
/// start where the log says they stood, or in their rest posture. Throws Error if the domain, the log or the state
/// in it is unusable, or another server has the log or the joints.
DdsServerSummary serve_hand(const DdsServerOptions& options);
DdsServerSummary serve_arm(const DdsServerOptions& options, const ArmSolver& solver,
                           const Eigen::Isometry3d& T_flange_wrist, const ArmJoints& rest);

}  // namespace glovebench
