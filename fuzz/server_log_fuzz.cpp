#include <cmath>

#include "core/robot/server/command_messages.h"
#include "core/robot/server/server_log.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const auto state = last_state(fuzz::as_text(data, size), arm_joint_names(), "log.jsonl");
    if (!state) return;
    for (const double position : state->positions) check(std::isfinite(position), "a position is finite");
    const std::string line =
        state_line({1, CommandState::stopped, state->positions, {}}, state->time_us, arm_joint_names()) + "\n";
    const auto again = last_state(line, arm_joint_names(), "again");
    check(again.has_value(), "a state returns");
    check(again->time_us == state->time_us, "its time returns");
    for (size_t j = 0; j < state->positions.size(); ++j) {
      const double position = state->positions[j], moved = std::abs(again->positions[j] - position);
      check(moved <= 1e-8 + 1e-12 * std::abs(position), "a position returns");
    }
    check_age(*state, state->time_us, 0, "log.jsonl");
    check(!age_text(*state, 0).empty(), "an age can be read");
  });
}
