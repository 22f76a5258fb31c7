// The hand's server as a process, with other senders as processes.
#include <gmock/gmock.h>

#include "eval/dds/robot_server_fixture.h"
#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

TEST_F(RobotServer, FollowsAStreamSaysWhereTheJointsAreAndEndsCleanly) {
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log), listener = listen();
  std::string script = "wait hand\nwait wrist\n";
  for (int i = 1; i <= 200; ++i) script += wrist(-5, i) + fingers(10, i) + "sleep 10\n";
  finish(talk(script));
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("glovebench: hand: no state in a log: starts at rest\n"));
  if (!had_gaps(run)) {  // a stamp each second, a message each 10 ms
    EXPECT_THAT(run.err, ContainsRegex("hand: left behind: commands come [0-9]+\\.[0-9] times as fast as their"));
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 2) << run.err;
  }
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("hand: messages: "), HasSubstr("; streams: "), HasSubstr("the longest gap")));
  EXPECT_EQ(good(log, "fingers"), 200);
  EXPECT_EQ(good(log, "wrist"), 200);
  EXPECT_GE(received(log, "fingers", "starting"), 10) << "0.2 s";
  EXPECT_NEAR(last_angle(log, "rh_FFJ3"), 10, 1e-6);
  EXPECT_NEAR(last_angle(log, "rh_WRJ1"), -5, 1e-6);
  expect_safe(log);

  const std::vector<std::string> states = lines_of("states", finish(listener).out);
  ASSERT_GT(states.size(), 50U);
  EXPECT_THAT(states.back(), HasSubstr(fmt::format(" rh_FFJ3={:.4f}", radians_from_degrees(10)).substr(0, 14)));
  for (const std::string& name : hand_joint_names()) EXPECT_THAT(states.back(), HasSubstr(" " + name + "="));
}

TEST_F(RobotServer, RefusesWhatIsWrongAndGoesOn) {
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log);
  std::string other_names = fingers(20, 12);
  other_names.replace(other_names.find("rh_FFJ1"), 7, "xx_FFJ1");
  finish(talk("wait hand\nwait wrist\n" + fingers(5, 10) + "again 60 10000\n" +  // valid
              fingers(20, 9) + fingers(20, 10) +                                 // goes back, comes twice
              fingers(std::nan(""), 11) + fingers(INFINITY, 11) + other_names +  // 2 not finite, wrong joints
              "hand 13 0 1" + joints(hand_joint_names(), 20) +                   // has the wrist: wrong joints
              "hand 13 0 1 rh_FFJ1=1\nhand 13 0 1 \n" +                          // 1 and 0 joints: wrong joints
              fingers(20, 14, 0) + fingers(20, 14, 2) +                          // 0 and 2 points
              "short 14 0" + joints(hand_trajectory_names(), 20) +               // one position too few
              "hand -1 0 1" + joints(hand_trajectory_names(), 20) +              // before 1970
              "hand 15 4000000000 1" + joints(hand_trajectory_names(), 20) +     // nanoseconds of four seconds
              fingers(1e9, 16) + fingers(10, 17) + "sleep 50\n"));               // clamped; valid
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("hand: messages: 2 bad_time, 4 wrong_joints, 3 wrong_points, 2 not_finite, "));
  const int64_t went_back = received(log, "fingers", "went_back");
  EXPECT_EQ(good(log, "fingers") + went_back, 61 + 2 + 2);
  if (!had_gaps(run)) {
    EXPECT_EQ(went_back, 2);
  }
  EXPECT_LE(last_angle(log, "rh_FFJ3"), 90);
  expect_safe(log);
}

TEST_F(RobotServer, TheFirstSenderOwnsItWhileAnotherFloods) {
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log);
  const StartedProgram owner = talk("wait hand\n" + fingers(10, 1) + "again 300 10000\n");
  ASSERT_TRUE(comes_true([&] { return received(log, "fingers", "accepted") > 0; }));
  const StartedProgram flooder = talk("wait hand\n" + fingers(80, 1) + "again 30000 0\n");
  EXPECT_EQ(finish(owner).out, "said\n");
  EXPECT_EQ(finish(flooder).out, "said\n");
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0);
  // If a flood pushed out the owner's messages, few of 301 would remain. A busy machine may lose some, since a
  // writer keeps 10.
  EXPECT_GE(good(log, "fingers"), 225) << "the owner is heard: " << run.out;
  EXPECT_THAT(run.out, HasSubstr(" foreign"));
  if (!had_gaps(run)) {  // the first to start again owns the server
    EXPECT_THAT(run.out, HasSubstr("streams: 1;"));
    EXPECT_LE(last_angle(log, "rh_FFJ3"), 10 + 1e-6);
  }
  expect_safe(log);
}

TEST_F(RobotServer, AFloodOfItsOwnerMovesNothingFaster) {
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log);
  finish(talk("wait hand\n" + fingers(10, 1) + "again 10000 0\n" + fingers(80, 2) + "again 10000 0\n"));
  EXPECT_EQ(stop(server, SIGTERM).exit_code, 0);
  EXPECT_LT(lines(log, "received").size(), 6000U) << "it does not fill the disk";
  expect_safe(log);
}

TEST_F(RobotServer, HoldsAndStopsWhenItsSenderDiesAndFollowsTheNext) {
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log);
  const StartedProgram first = talk("wait hand\n" + fingers(10, 1000) + "again 10000 10000\n");
  ASSERT_TRUE(comes_true([&] { return received(log, "fingers", "accepted") > 20; }));
  stop(first, SIGKILL);
  const auto state_is = [&](const char* state) { return last_line(log, "state").at("state") == state; };
  EXPECT_TRUE(comes_true([&] { return state_is("stopped"); }));
  // Holds before it stops, unless it had a pause.
  const std::vector<json> states = lines(log, "state");
  const auto held =
      std::find_if(states.rbegin(), states.rend(), [](const json& line) { return line.at("state") != "stopped"; });
  ASSERT_TRUE(held != states.rbegin() && held != states.rend());
  if (held->at("state") != "holding") {
    const int64_t elapsed_us = std::prev(held)->at("clock_us").get<int64_t>() - held->at("clock_us").get<int64_t>();
    EXPECT_GE(elapsed_us, 1e6 * (CommandLimits().stop_after_s - CommandLimits().silence_s) - 1);
  }
  finish(talk("wait hand\n" + fingers(20, 1) + "again 150 10000\n"));  // its time stamps start anew
  const ProgramRun run = stop(server, SIGTERM);
  if (!had_gaps(run)) {
    EXPECT_THAT(run.out, HasSubstr("streams: 2;"));
  }
  EXPECT_NEAR(last_angle(log, "rh_FFJ3"), 20, 1e-6);
  expect_safe(log);
}

TEST_F(RobotServer, GoesOnWhereItWasKilled) {
  const std::string log = path("hand.jsonl");
  const SimulatedRobot robot(std::stoi(domain_));
  StartedProgram server = serve_until_ready("hand", log);
  std::string script = "wait hand\n";  // back and forth, so that it is always moving
  for (int i = 0; i < 40; ++i) script += fingers(i % 2 ? 80 : 5, 1 + i) + "again 20 10000\n";
  const StartedProgram sender = talk(script);
  for (int round = 0; round < 3; ++round) {
    const int64_t before = received(log, "fingers", "accepted");
    ASSERT_TRUE(comes_true([&] { return received(log, "fingers", "accepted") > before + 40; }));
    stop(server, SIGKILL);
    server = serve_until_ready("hand", log);
  }
  EXPECT_EQ(finish(sender).out, "said\n") << "the stream goes on";
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  if (!had_gaps(run)) {
    EXPECT_THAT(run.out, HasSubstr("streams: 1;"));
  }
  expect_safe(log);
}

TEST_F(RobotServer, AfterAKillInMotionItWaitsForAMeasuredState) {
  const std::string log = path("hand.jsonl");
  StartedProgram server = serve_until_ready("hand", log);
  const StartedProgram sender = talk("wait hand\n" + fingers(60, 1) + "again 100000 10000\n");
  ASSERT_TRUE(comes_true([&] { return last_angle(log, "rh_FFJ3") > 1; }));
  stop(server, SIGKILL);
  const size_t size = std::filesystem::file_size(log);
  server = serve("hand", log);
  ASSERT_TRUE(comes_true([&] {
    return std::filesystem::exists(server.err) && read_file(server.err).find("measured state") != std::string::npos;
  }));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_EQ(std::filesystem::file_size(log), size) << "it has not begun, though a sender is there";
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "hand: ended before the joints were measured\n");
  stop(sender, SIGKILL);
}

TEST_F(RobotServer, StaleCommandsMoveNothing) {
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log);
  const StartedProgram sender =
      talk("wait hand\n" + fingers(10, 1) + "again 200 10000\n" + fingers(80, 2) + "again 100000 10000\n");
  ASSERT_TRUE(comes_true([&] { return last_angle(log, "rh_FFJ3") > 5; }));
  kill(server.process, SIGSTOP);
  const double stood = last_angle(log, "rh_FFJ3");
  std::this_thread::sleep_for(std::chrono::milliseconds(3500));  // the sender is at 80 degrees by now
  stop(sender, SIGKILL);
  std::this_thread::sleep_for(std::chrono::seconds(5));
  kill(server.process, SIGCONT);
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr(" stale"), HasSubstr("; gaps: ")));
  EXPECT_THAT(run.err, ContainsRegex("hand: left behind: [0-9]+ commands came more than 0.15 s late"));
  // It was moving to 10 degrees, and the last lines of the log were not yet written.
  EXPECT_LE(last_angle(log, "rh_FFJ3"), std::max(stood + 5, 10 + 1e-6));
  expect_safe(log);
}

TEST_F(RobotServer, NobodyHasToHearWhatItSays) {
  const std::string log = path("hand.jsonl");
  stop(serve_until_ready("hand", log), SIGTERM);
  const StartedProgram server = serve_until_ready("hand", log, {}, {.unheard = true});  // prints where it starts
  finish(talk("wait hand\n" + fingers(10, 1) + "again 200 10000\n"));
  EXPECT_NEAR(last_angle(log, "rh_FFJ3"), 10, 1e-6) << "it serves";
  EXPECT_EQ(stop(server, SIGTERM).exit_code, 128 + SIGPIPE)
      << "its last line was not heard; no signal has ended it";
}

TEST_F(RobotServer, ATerminalThatIsClosedEndsItCleanly) {
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log);
  const StartedProgram sender = talk("wait hand\n" + fingers(60, 1) + "again 100000 10000\n");
  ASSERT_TRUE(comes_true([&] { return last_angle(log, "rh_FFJ3") > 1; }));
  kill(server.process, SIGHUP);
  const ProgramRun run = stop(server, SIGHUP);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("hand: messages: "));
  stop(sender, SIGKILL);
  const json last = last_line(log, "interval");
  // Intervals are rounded outward, to 1e-6 degrees.
  EXPECT_NEAR(last.at("min_deg").at("rh_THJ3"), last.at("max_deg").at("rh_THJ3"), 2.5e-6)
      << "the log says where it stands";
  EXPECT_EQ(stop(serve_until_ready("hand", log), SIGTERM).exit_code, 0);
}

TEST_F(RobotServer, AFullDiskHoldsTheHand) {
  const StartedProgram listener = listen();
  const StartedProgram server = serve("hand", "/dev/full");
  ASSERT_TRUE(comes_true([&] { return !lines_of("states", said(listener)).empty(); }));
  finish(talk("wait hand\n" + fingers(10, 1) + "again 60 10000\n"));
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.out, AllOf(HasSubstr(" accepted"), HasSubstr("; held for the log: "),
                             HasSubstr("lines lost (No space left on device)")));
  EXPECT_THAT(run.err,
              AllOf(HasSubstr("/dev/full: found No space left on device: lines are lost, and the joints hold"),
                    HasSubstr("/dev/full: lines: found")));
  const std::vector<std::string> states = lines_of("states", finish(listener).out);
  ASSERT_FALSE(states.empty());
  EXPECT_THAT(states.back(), HasSubstr(" rh_FFJ3=0 ")) << "nobody would know where it is";
}

/// Peak memory of a process, bytes.
size_t peak_memory(const StartedProgram& program) {
  const std::string status = read_file(fmt::format("/proc/{}/status", program.process));
  return std::stoull(status.substr(status.find("VmHWM:") + 6)) * 1024;
}

TEST_F(RobotServer, AFloodOfHugeMessagesTakesNoMemory) {
  constexpr size_t kMegabyte = 1'000'000;
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log);
  const size_t before = peak_memory(server);
  const StartedProgram sender =
      talk("wait hand\nhuge names 1 100000000\nhuge points 1 50000000\nhuge names 500 15000\n" + fingers(10, 1) +
           "again 100000 10000\n");
  EXPECT_TRUE(comes_true([&] { return std::abs(last_angle(log, "rh_FFJ3") - 10) < 1e-6; })) << "still follows";
  EXPECT_LT(peak_memory(server), before + 90 * kMegabyte) << "a message alone would be more";
  stop(sender, SIGKILL);
  const ProgramRun run = stop(server, SIGTERM);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("; too large: "));
  EXPECT_LE(std::ranges::count(run.err, '\n'), 100) << run.err;
}

TEST_F(RobotServer, OneServesAHandAndALog) {
  const std::string log = path("hand.jsonl");
  const StartedProgram server = serve_until_ready("hand", log);
  const ProgramRun same_log = finish(serve("hand", log));
  EXPECT_EQ(same_log.exit_code, 2);
  EXPECT_EQ(same_log.err, "glovebench: " + log +
                              ": log: found another server that is writing it, expected a log of its own for each "
                              "server\n");
  const ProgramRun same_hand = finish(serve("hand", path("other.jsonl")));
  EXPECT_EQ(same_hand.exit_code, 2);
  EXPECT_THAT(same_hand.err, HasSubstr("another process that tells of rh_"));
  EXPECT_EQ(stop(server, SIGTERM).exit_code, 0);
  const StartedProgram next = serve_until_ready("hand", log);
  const ProgramRun run = stop(next, SIGTERM);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.err, HasSubstr("glovebench: " + log + ": starts at its last state, of 20"));
}

TEST_F(RobotServer, BelievesALogForAsLongAsItIsTold) {
  const std::string log = path("hand.jsonl");
  stop(serve_until_ready("hand", log), SIGTERM);
  ProgramRun run = finish(serve("hand", log, {"--log-age", "0"}));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("hand.jsonl: last state: found one of 20"), HasSubstr(" s ago, expected"),
                             HasSubstr("--log-age")));
  EXPECT_EQ(std::ranges::count(run.err, '\n'), 1);
  for (const char* wrong : {"-1", "x", "inf", "nan", "1e400"})
    EXPECT_EQ(finish(serve("hand", log, {"--log-age", wrong})).exit_code, 2);
}

TEST_F(RobotServer, RefusesLogsOfOthers) {
  write_file(path("letter"), "Dear robot,\n");
  ProgramRun run = finish(serve("hand", path("letter")));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("letter: lines: found none of a log of `robot-server`"));
  EXPECT_EQ(read_file(path("letter")), "Dear robot,\n");
  run = finish(serve("hand", "/nowhere/log"));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("/nowhere/log: file: found No such file"));
  run = finish(serve("foot", path("log")));
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("expected --hand, --arm or both"));
}

}  // namespace
}  // namespace glovebench::eval
