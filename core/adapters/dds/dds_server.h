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
  std::string log;
  /// Largest age of the log's last state, s.
  double max_log_age_s = kMaxLogAge;
  CommandLimits limits;
  std::function<bool()> stopping;  ///< polled at 100 Hz; true ends
  std::function<void(const std::string&)> tell = [](const std::string&) {};
};

struct DdsServerSummary {
  std::string text;
  int64_t lost_log_lines = 0;
};

/// Serves a robot until `stopping`. Publishes JointState at 100 Hz.
/// Throws: Error if domain or log is unusable or in use by another server.
DdsServerSummary serve(const DdsServerOptions& options);

}  // namespace glovebench
