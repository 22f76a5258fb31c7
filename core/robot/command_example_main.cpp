// Prints a few lines of robot commands: each state, with and without an arm. For the test of their schema.
#include <cstdio>

#include "core/base/math.h"
#include "core/robot/command_guard.h"
#include "core/robot/robot_command.h"
#include "core/robot/test_commands.h"

int main() {
  using namespace glovebench;
  CommandGuard guard;
  const auto print = [&](const RobotCommand& command) {
    std::printf("%s\n", to_json_line(guard.guard(command).value()).c_str());
  };
  print(lost_command(-1));
  RobotCommand grasp = good_command(0);
  for (const ShadowJoint joint : {kFFJ3, kMFJ2, kLFJ1, kTHJ4, kWRJ2})
    set_joint(*grasp.targets, joint, radians_from_degrees(100));
  print(grasp);
  RobotCommand far = good_command(33'333);
  far.targets->T_base_hand = Eigen::Translation3d(0.6, 0, 3) * Eigen::AngleAxisd(1, Eigen::Vector3d::UnitX());
  far.targets->arm = ArmJoints{0.1, 0.5, 0, 1.5, 0, 1.1, 9};
  print(far);
  print(lost_command(66'667));
  print(lost_command(1'000'000));
}
