// Robot commands over DDS. The receiving processes share only the messages' definitions with the sender.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <bit>
#include <nlohmann/json.hpp>

#include "ci/build_paths.h"
#include "core/adapters/dds/command_messages.h"
#include "core/adapters/dds/dds_sink.h"
#include "core/base/math.h"
#include "core/robot/test_commands.h"
#include "eval/command_test.h"
#include "eval/dds/test_programs.h"

namespace glovebench::eval {
namespace {

using testing::HasSubstr;

using nlohmann::json;

class Dds : public DdsBus {
 protected:
  /// Command i of a stream at 30 Hz in which all joints move.
  static RobotCommand command(int i) {
    RobotCommand command = good_command(1'000'000 + 33'333 * int64_t{i});
    for (int j = 0; j < kShadowJointCount; ++j)
      set_joint(*command.targets, static_cast<ShadowJoint>(j), 0.001 * i + 0.01 * j);
    command.targets->T_base_hand.translation() = Eigen::Vector3d(0.5, 0.001 * i, 0.25);
    return command;
  }
  static void send(DdsSink& sink, int from, int to, int pause_ms = 2) {
    for (int i = from; i < to; ++i) {
      sink.send(command(i));
      std::this_thread::sleep_for(std::chrono::milliseconds(pause_ms));
    }
  }
  static void await_listener(const DdsSink& sink) {
    ASSERT_TRUE(comes_true([&] { return sink.listeners() > 0; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // for discovery of the sender
  }
  static std::string stamp(int i) {
    const int64_t us = 1'000'000 + 33'333 * int64_t{i};
    return fmt::format("{}.{:09}", us / 1'000'000, us % 1'000'000 * 1000);
  }
  static std::string values(const std::vector<std::string>& names, int first, int i) {
    std::string text;
    for (size_t j = 0; j < names.size(); ++j)
      text += fmt::format(" {}={:.17g}", names[j], 0.001 * i + 0.01 * (first + static_cast<int>(j)));
    return text;
  }
  /// A line without source time (its second word) and time of receipt.
  static std::string without_times(const std::string& line) {
    const size_t begin = line.find(' ') + 1, source_end = line.find(' ', begin) + 1;
    return line.substr(0, begin) + line.substr(source_end, line.find(" received ") - source_end);
  }
};

TEST_F(Dds, AWholeStreamArrives) {
  constexpr int kCommands = 300;
  const StartedProgram listener = listen();
  DdsSink sink(std::stoi(domain_));
  await_listener(sink);
  send(sink, 0, kCommands);
  sink.finish();
  EXPECT_EQ(sink.sent(), kCommands);
  const std::string text = finish(listener).out;
  const std::vector<std::string> hands = lines_of("hand", text), wrists = lines_of("wrist", text),
                                 poses = lines_of("pose", text);
  ASSERT_EQ(hands.size(), size_t{kCommands});
  ASSERT_EQ(wrists.size(), size_t{kCommands});
  ASSERT_EQ(poses.size(), size_t{kCommands});
  for (int i = 0; i < kCommands; ++i) {
    const auto at = static_cast<size_t>(i);
    const std::string head = stamp(i) + " \"\" point 0.100000000";
    EXPECT_EQ(without_times(hands[at]), "hand " + head + values(hand_trajectory_names(), 0, i));
    EXPECT_EQ(without_times(wrists[at]), "wrist " + head + values(wrist_trajectory_names(), kWRJ1, i));
    const ros::PoseStamped pose = pose_message(command(i));
    EXPECT_EQ(without_times(poses[at]),
              fmt::format("pose {} \"base_link\" {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", stamp(i),
                          pose.x, pose.y, pose.z, pose.qx, pose.qy, pose.qz, pose.qw));
  }
}

TEST_F(Dds, BytesAreThoseOfRos2) {
  const StartedProgram listener = start({build_paths::program("dds_probe"), "raw", domain_, "20"});
  ASSERT_TRUE(comes_true([&] { return said(listener).find("ready") != std::string::npos; }));
  DdsSink sink(std::stoi(domain_));
  const RobotCommand sent = command(7);
  while (kill(listener.process, 0) == 0 && said(listener).find("0001") == std::string::npos) {
    sink.send(sent);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const std::string text = finish(listener).out;

  // Common Data Representation, version 1, little-endian, of trajectory_msgs/JointTrajectory.
  std::string bytes;
  const auto put = [&](uint64_t value, size_t size) {
    while (bytes.size() % size != 0) bytes += '\0';
    for (size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
  };
  const auto put_text = [&](const std::string& word) {
    put(word.size() + 1, 4);
    bytes += word + '\0';
  };
  put(1, 4), put(233'331'000, 4);  // header.stamp
  put_text("");                    // header.frame_id
  put(22, 4);
  for (const std::string& name : hand_trajectory_names()) put_text(name);
  put(1, 4);  // points
  put(22, 4);
  for (int j = 0; j < 22; ++j) put(std::bit_cast<uint64_t>(0.001 * 7 + 0.01 * j), 8);
  put(0, 4), put(0, 4), put(0, 4);  // velocities, accelerations, effort
  put(0, 4);                        // time_from_start.sec; the rest differs between messages
  std::string hex = "0001";
  for (const char byte : bytes) hex += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  const std::string found = text.substr(text.find('\n') + 1);
  EXPECT_EQ(found.substr(0, 4), "0001");
  EXPECT_EQ(found.substr(8, hex.size() - 4), hex.substr(4)) << "after the four bytes of its header";
}

TEST_F(Dds, NobodyHasToListen) {
  DdsSink sink(std::stoi(domain_));
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 2000; ++i) sink.send(command(i));
  sink.finish();
  EXPECT_EQ(sink.sent(), 2000);
  EXPECT_EQ(sink.listeners(), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST_F(Dds, WhoComesLateGetsWhatFollows) {
  DdsSink sink(std::stoi(domain_));
  send(sink, 0, 50);
  const StartedProgram listener = listen();
  await_listener(sink);
  send(sink, 50, 100);
  sink.finish();
  const std::vector<std::string> hands = lines_of("hand", finish(listener).out);
  ASSERT_EQ(hands.size(), 50U);
  for (size_t i = 0; i < hands.size(); ++i)
    EXPECT_THAT(hands[i], HasSubstr(fmt::format(" {} ", stamp(50 + static_cast<int>(i)))));
}

TEST_F(Dds, AListenerThatDiesHoldsNothingUp) {
  const StartedProgram doomed = listen("100"), other = listen();
  DdsSink sink(std::stoi(domain_));
  ASSERT_TRUE(comes_true([&] { return sink.listeners() == 2; }));
  await_listener(sink);
  send(sink, 0, 50);
  stop(doomed, SIGKILL);
  double longest_ms = 0;
  for (int i = 50; i < 250; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    sink.send(command(i));
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    longest_ms = std::max(longest_ms, took.count());
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const auto begin = std::chrono::steady_clock::now();
  sink.finish();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3)) << "it waits a second for the dead";
  EXPECT_LT(longest_ms, 500);
  EXPECT_EQ(lines_of("hand", finish(other).out).size(), 250U) << "who lives gets all";
}

TEST_F(Dds, SendsNothingThatIsNoCommand) {
  const StartedProgram listener = listen();
  DdsSink sink(std::stoi(domain_));
  await_listener(sink);
  sink.send(lost_command(1));  // nothing was tracked yet
  RobotCommand held = command(1);
  held.hold = true;
  held.state = CommandState::holding;
  sink.send(held);
  RobotCommand bad = command(1);
  bad.targets->hand.joints[3] = std::nan("");
  EXPECT_THROW(sink.send(bad), Error);
  sink.send(command(2));
  sink.finish();
  EXPECT_EQ(sink.sent(), 1);
  const std::vector<std::string> hands = lines_of("hand", finish(listener).out);
  ASSERT_EQ(hands.size(), 1U);
  EXPECT_THAT(hands[0], HasSubstr(stamp(2)));
}

TEST_F(Dds, RefusesWhatIsNoDomainOrNoNetwork) {
  EXPECT_THROW(DdsSink(-1), Error);
  EXPECT_THROW(DdsSink(231), Error);
  setenv("CYCLONEDDS_URI",
         "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"none\"/></Interfaces>"
         "</General></Domain></CycloneDDS>",
         1);
  EXPECT_THROW(DdsSink{std::stoi(domain_)}, Error);
}

TEST_F(Dds, TheCommandLineNamesWhatItDoesNotKnow) {
  for (const char* wrong : {"ros", "dds:", "dds:x", "dds:-1", "dds:1x", "dds:999", ""}) {
    const ProgramRun run = run_glovebench({"robot-server", "run", "--hand", "--robot", wrong});
    EXPECT_EQ(run.exit_code, 2) << wrong;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  EXPECT_THAT(
      run_glovebench({"track", "--source", "fakenect:x", "--database", "x", "-o", "x.jsonl", "--robot", "ros"}).err,
      HasSubstr("--robot: middleware: found ros, expected dds or dds:DOMAIN"));
}

/// From frames to messages.
class DdsTrack : public CommandTest {};

TEST_F(DdsTrack, StreamsWhatItWrites) {
  use_loopback_dds();
  const std::string domain = "7";
  render_recording("good.json", "dump");
  const StartedProgram listener = start_program({build_paths::program("dds_probe"), "listen", domain, "20", "12"});
  ASSERT_TRUE(comes_true([&] {
    return std::filesystem::exists(listener.out) && read_file(listener.out).find("ready") != std::string::npos;
  }));
  expect_fine(
      track("dump", "DB_open_power", "e.jsonl", {"--robot", "dds:" + domain, "--robot-out", path("r.jsonl")}));
  const std::string heard = finish_program(listener).out;
  std::istringstream lines(read_file(path("r.jsonl")));
  std::istringstream all(heard);
  std::vector<std::string> hands;
  for (std::string line; std::getline(all, line);)
    if (line.starts_with("hand ")) hands.push_back(line);
  ASSERT_EQ(hands.size(), size_t{kFrames}) << heard;
  size_t i = 0;
  for (std::string line; std::getline(lines, line); ++i) {
    const json command = json::parse(line);
    const auto at_us = command.at("frame_timestamp_us").get<int64_t>();
    EXPECT_THAT(hands.at(i), HasSubstr(fmt::format(" {}.{:09} ", at_us / 1'000'000, at_us % 1'000'000 * 1000)));
    for (const auto& [name, angle_deg] : command.at("joints").at("target_deg").items()) {
      if (name.starts_with("WR")) continue;
      const size_t value = hands[i].find("rh_" + name + "=");
      ASSERT_NE(value, std::string::npos) << name;
      EXPECT_NEAR(degrees_from_radians(std::stod(hands[i].substr(value + name.size() + 4))),
                  angle_deg.get<double>(), 1e-6)
          << name;
    }
  }
  EXPECT_EQ(i, hands.size());
}

}  // namespace
}  // namespace glovebench::eval
