#include <cmath>

#include "core/robot/server/command_messages.h"
#include "core/robot/server/server_log.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const auto positions = last_positions(fuzz::as_text(data, size), arm_joint_names(), "log.jsonl");
    if (!positions) return;
    for (const double position : *positions) check(std::isfinite(position), "a position is finite");
    const std::string line = state_line({1, CommandState::stopped, *positions, {}}, 2, arm_joint_names()) + "\n";
    const auto again = last_positions(line, arm_joint_names(), "again");
    check(again.has_value(), "a state returns");
    for (size_t j = 0; j < positions->size(); ++j) {
      const double moved = std::abs((*again)[j] - (*positions)[j]);
      check(moved <= 1e-8 + 1e-12 * std::abs((*positions)[j]), "a position returns");
    }
  });
}
