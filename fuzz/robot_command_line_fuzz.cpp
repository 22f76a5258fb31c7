#include "core/robot/json_lines_reader.h"
#include "core/robot/json_lines_sink.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const RobotCommand command = parse_command_line(fuzz::as_text(data, size), "line");
    const RobotCommand again = parse_command_line(to_json_line(command), "again");
    check(again.timestamp_us == command.timestamp_us && again.status == command.status &&
              again.state == command.state && again.hold == command.hold &&
              again.interventions == command.interventions &&
              again.targets.has_value() == command.targets.has_value(),
          "a command returns");
    if (!command.targets) return;
    // Rounded to 1e-6 of degrees, metres and quaternions; large numbers have no such digits.
    for (int j = 0; j < kShadowJointCount; ++j)
      check(std::abs(again.targets->hand.joints[j] - command.targets->hand.joints[j]) <=
                1e-8 + 1e-15 * std::abs(command.targets->hand.joints[j]),
            "a joint returns");
    check(again.targets->T_base_hand.linear().isApprox(command.targets->T_base_hand.linear(), 1e-5),
          "a pose returns");
    check(again.targets->hand.joint_clamped == command.targets->hand.joint_clamped &&
              again.targets->hand.actuator_clamped == command.targets->hand.actuator_clamped &&
              again.targets->arm.has_value() == command.targets->arm.has_value(),
          "what is told of targets returns");
  });
}
