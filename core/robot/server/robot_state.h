#pragma once

#include <cstdint>
#include <vector>

#include "core/robot/command_state.h"

namespace glovebench {

/// A moment by the two clocks of a server, us.
struct ServerTime {
  int64_t clock_us = 0;   ///< does not go back
  int64_t system_us = 0;  ///< since 1970; may be set
};

/// What a server of the robot sends to its joints, and so where they stand.
struct RobotState {
  int64_t clock_us = 0;  ///< of the server, which does not go back
  CommandState state = CommandState::stopped;
  std::vector<double> position;  ///< rad
  std::vector<double> velocity;  ///< rad/s, since the state before; zero at first
};

}  // namespace glovebench
