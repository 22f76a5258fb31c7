#include "core/robot/json_lines_reader.h"

#include <gmock/gmock.h>

#include "core/base/angles.h"
#include "core/base/damaged_text.h"
#include "core/base/error.h"
#include "core/base/file.h"
#include "core/robot/json_lines_sink.h"
#include "core/robot/test_commands.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

using testing::HasSubstr;

/// A line with all that a line may hold.
RobotCommand full_command(int64_t timestamp_us) {
  RobotCommand command = good_command(timestamp_us);
  RobotTargets& targets = *command.targets;
  set_joint(targets, kMFJ2, radians_from_degrees(45.5));
  set_joint(targets, kFFJ4, radians_from_degrees(-20));
  targets.hand.joint_clamped[kFFJ4] = targets.hand.actuator_clamped[2] = true;
  targets.T_base_hand.linear() = Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5).toRotationMatrix();
  targets.arm = ArmJoints{0.1, -0.2, 0.3, 1.4, -0.5, 0.6, 4};
  command.interventions.add(Intervention::joint_limit);
  command.interventions.add(Intervention::stale, 12);
  return command;
}

std::string message_of(std::string line) {
  try {
    parse_command_line(line, "line 7");
    return "no error";
  } catch (const Error& error) {
    return error.what();
  }
}
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return place == std::string::npos ? text : text.replace(place, from.size(), to);
}

TEST(CommandLineReader, ReadsWhatIsWritten) {
  RobotCommand held = lost_command(5);
  held.targets = full_command(0).targets;
  held.state = CommandState::holding;
  for (const RobotCommand& command : {full_command(66'667), good_command(-3), lost_command(0), held}) {
    const std::string line = to_json_line(command);
    EXPECT_EQ(to_json_line(parse_command_line(line, "line")), line);
    EXPECT_EQ(parse_command_line(line + "\n", "line").timestamp_us, command.timestamp_us);
  }
  const RobotCommand read = parse_command_line(to_json_line(full_command(7)), "line");
  EXPECT_NEAR(read.targets->hand.joints[kMFJ2], radians_from_degrees(45.5), 1e-12);
  EXPECT_TRUE(read.targets->hand.joint_clamped[kFFJ4]);
  EXPECT_EQ(read.interventions, full_command(7).interventions);
  RobotCommand turned = full_command(7);
  turned.targets->T_base_hand.linear() =
      Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_TRUE(parse_command_line(to_json_line(turned), "line")
                  .targets->T_base_hand.isApprox(turned.targets->T_base_hand, 2e-6))
      << "its four numbers are rounded, and made a unit quaternion again";
  EXPECT_NEAR(read.targets->arm->at(6), 4, 1e-8) << "rounded to a millionth of a degree";
}

TEST(CommandLineReader, SaysWhatIsWrong) {
  const std::string line = to_json_line(full_command(66'667));
  const auto message = [&](const std::string& from, const std::string& to) {
    return message_of(replaced(line, from, to));
  };
  EXPECT_THAT(message_of("{"), AllOf(HasSubstr("line 7: column 2: found the end"), HasSubstr("expected JSON")));
  EXPECT_THAT(message_of("[]"), HasSubstr("expected an object"));
  EXPECT_THAT(message("\"hold\":false,", ""), HasSubstr("no key \"hold\""));
  EXPECT_THAT(message("\"hold\":false", "\"hold\":false,\"hold\":false"), HasSubstr("hold: found the key twice"));
  EXPECT_THAT(message("\"hold\":false", "\"hold\":true"), HasSubstr("hold: found true, expected false with state"));
  EXPECT_THAT(message("\"hold\":false", "\"hold\":0"), HasSubstr("expected true or false"));
  EXPECT_THAT(message("\"timestamp_us\":66667", "\"timestamp_us\":66667.5"), HasSubstr("expected a whole number"));
  EXPECT_THAT(message("\"timestamp_us\":66667", "\"timestamp_us\":9223372036854775808"),
              HasSubstr("a whole number"));
  EXPECT_THAT(message("\"tracked\"", "\"trackd\""), HasSubstr("status: found \"trackd\", expected a status"));
  EXPECT_THAT(message("\"following\"", "\"flying\""), HasSubstr("following, holding or stopped"));
  EXPECT_THAT(message("\"stale\":12", "\"stale\":0"), HasSubstr("interventions.stale: found 0"));
  EXPECT_THAT(message("\"stale\":12", "\"mood\":12"), HasSubstr("unknown key \"mood\""));
  EXPECT_THAT(message("\"FFJ4\":-20.0", "\"FFJ4\":null"), HasSubstr("actuators.target_deg.FFJ4: found null"));
  EXPECT_THAT(message("\"FFJ4\":-20.0", "\"FFJ4\":1e10"), HasSubstr("a number from"));
  EXPECT_THAT(message("\"FFJ4\":-20.0", "\"FFJ9\":-20.0"), HasSubstr("no key \"FFJ4\""));
  EXPECT_THAT(message("\"FFJ4\":-20.0", "\"FFJ4\":1e999"), HasSubstr("no double can hold"));
  EXPECT_THAT(message("[\"FFJ4\"]", "[\"FFJ4\",\"FFJ4\"]"), HasSubstr("a name twice"));
  EXPECT_THAT(message("[\"FFJ4\"]", "[3]"), HasSubstr("actuators.clamped[0]: found 3"));
  EXPECT_THAT(message("[0.5,0.0,0.5]", "[0.5,0.0]"), HasSubstr("found 2 elements, expected 3"));
  EXPECT_THAT(message("\"rotation_wxyz\":[0.", "\"rotation_wxyz\":[1."), HasSubstr("a unit quaternion"));
  EXPECT_THAT(message("\"S1\"", "\"S0\""), HasSubstr("arm.target_deg: found no key \"S1\""));
  EXPECT_THAT(message_of(std::string(kLongestCommandLine + 1, ' ')), HasSubstr("at most 16384"));
  EXPECT_THAT(message_of(replaced(to_json_line(lost_command(1)), "\"stopped\"", "\"following\"")),
              HasSubstr("hold"));
  EXPECT_THAT(message_of(replaced(to_json_line(lost_command(1)), "\"arm\":null", "\"arm\":{}")), HasSubstr("arm"));
}

TEST(CommandLineReader, DamageIsRefusedOrHarmless) {
  RandomStream random(1, "command line", 0, "damage");
  const std::string line = to_json_line(full_command(66'667));
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    try {
      to_json_line(parse_command_line(damaged_text(line, random), "line"));
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
      ++refused;
    }
  }
  EXPECT_GT(refused, 2000);
}

TEST(CommandLineReader, ReadsFilesInTimeOrder) {
  const std::string path = test_folder() + "/commands.jsonl";
  write_file(path, to_json_line(lost_command(1)) + "\n" + to_json_line(full_command(2)) + "\n");
  ASSERT_EQ(read_command_lines(path).size(), 2U);
  EXPECT_EQ(read_command_lines(path)[1].timestamp_us, 2);
  write_file(path, to_json_line(lost_command(1)) + "\n" + to_json_line(full_command(1)) + "\n");
  try {
    read_command_lines(path);
    FAIL() << "two commands at one time";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("commands.jsonl:2: timestamp_us: found 1, expected more than 1"));
  }
}

}  // namespace
}  // namespace glovebench
