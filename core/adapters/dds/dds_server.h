#pragma once

#include <functional>
#include <string>

#include "core/adapters/dds/dds_access.h"
#include "core/adapters/dds/server/robot_server.h"
#include "core/adapters/dds/server/server_log.h"

namespace glovebench {

struct DdsServerOptions {
  int domain = 0;
  DdsAccess access;
  ServedRobot robot;
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

/// Serves a robot (`RobotServer`) over DDS until it shall stop: takes commands, and a hundred times a second sends
/// where the joints shall be as their state, `sensor_msgs/JointState`. The joints start where the log says they
/// stood, or at rest. Throws Error if the domain, the log or the state in it is unusable, or another server has the
/// log or is in the domain.
DdsServerSummary serve(const DdsServerOptions& options);

}  // namespace glovebench
