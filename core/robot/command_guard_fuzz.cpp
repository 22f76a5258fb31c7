
#include "core/base/fuzz_target.h"
#include "core/robot/test_commands.h"
#include "core/robot/test_stream_checker.h"

namespace glovebench {
namespace {

/// A change to a command: which of its values, and the new one.
void change(RobotCommand& command, FuzzInput& input) {
  const uint8_t field = input.next<uint8_t>();
  if (field >= 250) command.targets = field >= 253 ? good_command(0).targets : std::nullopt;
  if (field >= 240 && field < 250) command.hold = (field & 1) != 0;
  if (field >= 230 && field < 240) command.state = static_cast<CommandState>(field % kCountOf<CommandState>);
  if (field >= 220 && field < 230) command.status = static_cast<TrackStatus>(field % kCountOf<TrackStatus>);
  if (field >= 210 && field < 220) command.frame_timestamp_us = input.next<int64_t>();
  if (field >= 200 || !command.targets) return;
  RobotTargets& targets = *command.targets;
  const auto value = input.next<double>();
  if (field < 24) return set_joint(targets, static_cast<ShadowJoint>(field), value);
  if (field < 48) targets.hand.joints[field - 24] = value;
  if (field >= 48 && field < 68) targets.hand.actuators[field - 48] = value;
  if (field >= 68 && field < 71) targets.T_base_hand.translation()[field - 68] = value;
  if (field >= 71 && field < 80) targets.T_base_hand.linear()((field - 71) / 3, (field - 71) % 3) = value;
  if (field >= 80 && field < 83)
    targets.T_base_hand.rotate(Eigen::AngleAxisd(value, Eigen::Vector3d::Unit(field - 80)));
  if (field < 83 || field >= 90) return;
  if (!targets.arm) targets.arm.emplace();
  (*targets.arm)[field - 83] = value;
}

}  // namespace

/// A stream: each record changes the last command in a few places, and gives it to a guard.
void command_guard_fuzz(std::string_view bytes) {
  without_error([&] {
    FuzzInput input(bytes);
    const uint8_t kind_of_stream = input.next<uint8_t>();
    const bool has_clock = (kind_of_stream & 1) != 0;
    CommandLimits limits;
    if ((kind_of_stream & 2) != 0) limits.coupling = ShadowCoupling::even;
    CommandGuard guard(limits);
    StreamChecker checker(limits);
    RobotCommand command = good_command(0);
    int64_t now_us = 0;
    if ((kind_of_stream & 4) != 0) {  // a finger that touches something
      RobotTargets start = *command.targets;
      const double proximal = input.next<uint8_t>() / 256.0, distal = proximal * input.next<uint8_t>() / 256.0;
      set_joint(start, kFFJ2, proximal);
      set_joint(start, kFFJ1, distal);
      guard.start_from(start);
      checker.start(start);
    }
    while (!input.empty()) {
      const uint8_t kind = input.next<uint8_t>();
      const int64_t step_us = (kind & 1) != 0 ? input.next<int64_t>() : input.next<uint16_t>();
      command.timestamp_us =
          static_cast<int64_t>(static_cast<uint64_t>(command.timestamp_us) + static_cast<uint64_t>(step_us));
      now_us = static_cast<int64_t>(static_cast<uint64_t>(now_us) + static_cast<uint64_t>(step_us));
      if ((kind & 2) != 0) command.frame_timestamp_us = command.timestamp_us;
      for (int i = kind >> 5; i > 0; --i) change(command, input);
      std::optional<RobotCommand> sent;
      if (!has_clock) sent = guard.guard(command);
      if (has_clock) sent = (kind & 4) != 0 ? guard.tick(now_us) : guard.guard(command, now_us);
      if (sent) check(checker.problem(*sent).empty(), "what a guard sends is safe");
    }
  });
}

}  // namespace glovebench
