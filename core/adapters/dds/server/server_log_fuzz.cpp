#include <cmath>

#include "core/adapters/dds/command_messages.h"
#include "core/adapters/dds/server/server_log.h"
#include "core/base/fuzz_target.h"

namespace glovebench {
namespace {

/// What is read of an interval is inside of what is written of it, and no more than rounding is added.
void check_interval(std::string_view log) {
  const auto interval = last_interval(log, arm_joint_names(), "log.jsonl");
  if (!interval) return;
  const auto again =
      last_interval(interval_line(*interval, 1, arm_joint_names()) + "\n", arm_joint_names(), "again");
  check(again.has_value(), "an interval returns");
  for (size_t j = 0; j < interval->min.size(); ++j) {
    check(interval->min[j] <= interval->max[j], "an interval has its ends in order");
    check(again->min[j] <= interval->min[j] + 1e-12 && again->max[j] >= interval->max[j] - 1e-12,
          "an interval is rounded outwards");
    check(again->min[j] >= interval->min[j] - 2e-8 && again->max[j] <= interval->max[j] + 2e-8,
          "an interval returns");
  }
}

}  // namespace

void server_log_fuzz(std::string_view bytes) {
  check_interval(bytes);
  const auto state = last_state(bytes, arm_joint_names(), "log.jsonl");
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
}

}  // namespace glovebench
