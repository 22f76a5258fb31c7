#include <fmt/format.h>

#include "core/adapters/dds/dds_server.h"
#include "core/adapters/dds/robot_bus.h"
#include "core/base/error.h"

namespace glovebench {
namespace {

[[noreturn]] void refuse(int domain) {
  throw Error("DDS", fmt::format("domain {}", domain), "a glovebench that was built without Cyclone DDS",
              "one that was configured with it (Debian: cyclonedds-dev, cyclonedds-tools)");
}

}  // namespace

const bool kHasDds = false;

std::unique_ptr<RobotBus> join_robot_bus(const RobotBusOptions& options) { refuse(options.domain); }

DdsServerSummary serve(const DdsServerOptions& options) { refuse(options.domain); }

}  // namespace glovebench
