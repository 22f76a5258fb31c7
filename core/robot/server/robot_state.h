#pragma once

#include <cstdint>
#include <vector>

#include "core/robot/command_state.h"

namespace glovebench {

/// What a server of the robot sends to its joints, and so where they stand.
struct RobotState {
  int64_t clock_us = 0;  ///< of the server, which does not go back
  CommandState state = CommandState::stopped;
  std::vector<double> position;  ///< rad
  std::vector<double> velocity;  ///< rad/s, since the state before; zero at first
};

}  // namespace glovebench
