#include "core/adapters/dds/dds_server.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <mutex>

#include "core/adapters/dds/command_messages.h"
#include "core/adapters/dds/dds_access.h"
#include "core/adapters/dds/dds_sink.h"
#include "core/adapters/dds/test_peers.h"
#include "core/adapters/system_time.h"
#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/math.h"
#include "core/base/whole_file.h"
#include "core/robot/arm.h"
#include "core/robot/test_commands.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// A server in a thread of this process.
class RunningServer {
 public:
  explicit RunningServer(DdsServerOptions options) {
    options.stopping = [this] { return stopping_.load(); };
    options.tell = [this](const std::string& line) {
      const std::lock_guard lock(mutex_);
      told_.push_back(line);
    };
    thread_ = std::thread([this, options] {
      try {
        summary_ = serve(options).text;
      } catch (const Error& e) {
        failure_ = e.what();
      }
      ended_ = true;
    });
  }
  ~RunningServer() { stop(); }
  RunningServer(const RunningServer&) = delete;
  RunningServer& operator=(const RunningServer&) = delete;

  /// What it says at its end, which a failure has brought or this brings.
  std::string stop() {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
    return summary_;
  }
  std::string failure() {
    EXPECT_TRUE(comes_true([&] { return ended_.load(); }));
    stop();
    return failure_;
  }
  std::vector<std::string> told() {
    const std::lock_guard lock(mutex_);
    return told_;
  }

 private:
  std::atomic<bool> stopping_ = false, ended_ = false;
  std::mutex mutex_;
  std::vector<std::string> told_;
  std::string summary_, failure_;
  std::thread thread_;
};

/// An arm that reaches nothing.
class NoSolver : public ArmSolver {
 public:
  std::optional<ArmJoints> solve(const Eigen::Isometry3d&, const ArmJoints&) const override { return std::nullopt; }
};

class DdsServer : public testing::Test {
 protected:
  void SetUp() override {
    use_loopback_dds(kFarDomain);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  static DdsServerOptions options(const std::string& log, int domain = kDomain) {
    DdsServerOptions options;
    options.domain = domain;
    options.log = log;
    return options;
  }
  static std::unique_ptr<RunningServer> hand(const DdsServerOptions& options) {
    return std::make_unique<RunningServer>(options);
  }
  std::unique_ptr<RunningServer> arm(DdsServerOptions options, bool with_hand = false) const {
    options.robot = {with_hand, MountedArm{&solver_, default_T_flange_wrist()}};
    return std::make_unique<RunningServer>(options);
  }
  static bool serves(const std::string& log, size_t begin = 0) {
    return comes_true([&] { return std::filesystem::exists(log) && std::filesystem::file_size(log) > begin; });
  }
  /// Has the server begun, so that the log says where the joints are?
  static bool has_state_after(const std::string& log, size_t begin) {
    return read_file(log).find(R"("event":"state")", begin) != std::string::npos;
  }
  static void change_at(const std::string& log, int64_t time_us) {
    const std::chrono::sys_time<std::chrono::microseconds> time{std::chrono::microseconds(time_us)};
    std::filesystem::last_write_time(log, std::chrono::file_clock::from_sys(time));
  }
  /// A log with one state, which nobody has changed since then.
  static void write_log(const std::string& log, const std::vector<std::string>& names,
                        const std::vector<double>& positions, int64_t time_us) {
    write_file(log, state_line({1, CommandState::stopped, positions, {}}, time_us, names) + "\n" +
                        interval_line({positions, positions}, time_us, names) + "\n");
    change_at(log, time_us);
  }
  static std::vector<double> last_positions(const std::string& log, const std::vector<std::string>& names) {
    return last_state(read_file(log), names, log).value().positions;
  }

  std::string folder_ = test_folder();
  const NoSolver solver_;
};

TEST_F(DdsServer, TheHandFollowsAStreamOverTheNetwork) {
  const std::string log = path("hand.jsonl");
  const auto server = hand(options(log));
  ASSERT_TRUE(serves(log));
  DdsSink sink(kFar);
  RobotCommand command = good_command(1'000'000);
  set_joint(*command.targets, kFFJ3, 0.2);
  const auto arrived = [&] { return read_file(log).find("\"accepted\"") != std::string::npos; };
  for (int i = 0; i < 2000 && !arrived(); ++i) {  // until both have found each other
    command.frame_timestamp_us += 10'000;
    sink.send(command);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  // It moves for 0.1 s, as soon as the disk has what its log states.
  const auto there = [&] { return std::abs(last_positions(log, hand_joint_names())[kFFJ3] - 0.2) < 1e-8; };
  for (int i = 0; i < 2000 && !there(); ++i) {
    command.frame_timestamp_us += 10'000;
    sink.send(command);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  sink.finish();
  EXPECT_THAT(server->stop(),
              AllOf(HasSubstr(" accepted; streams: "), HasSubstr(" starting, "), HasSubstr("the longest gap")));
  EXPECT_THAT(server->told(), ElementsAre(HasSubstr("hand: no state in a log: starts at rest")));
  EXPECT_NEAR(last_positions(log, hand_joint_names())[kFFJ3], 0.2, 1e-8);
}

TEST_F(DdsServer, AFloodOfLargeMessagesIsRefusedAndOthersAreFollowed) {
  const std::string log = path("hand.jsonl");
  const auto server = hand(options(log));
  ASSERT_TRUE(serves(log));
  const UnboundedWriter hostile(topics::kOwn.hand);
  ASSERT_TRUE(comes_true([&] { return hostile.listeners() > 0; }));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // the server knows it a little later
  for (int i = 0; i < 20; ++i) hostile.write({{}, "", {std::string(2'000'000, 'x')}, {}});
  for (int i = 0; i < 20; ++i) hostile.write({{}, "", {std::string(15'000, 'x')}, {}});
  ros::JointTrajectory good{{1, 0}, "", hand_trajectory_names(), {{std::vector<double>(22, 0.1), {}}}};
  EXPECT_TRUE(comes_true([&] {
    ++good.stamp.nanosec;
    hostile.write(good);
    return read_file(log).find("\"accepted\"") != std::string::npos;
  }));
  const std::string summary = server->stop();
  EXPECT_THAT(summary, AllOf(HasSubstr("20 wrong_joints, "), HasSubstr(" accepted; "),
                             HasSubstr("; too large: 20 messages")));
}

TEST_F(DdsServer, TwoDoNotShareALog) {
  const std::string log = path("hand.jsonl");
  const auto first = hand(options(log));
  ASSERT_TRUE(serves(log));
  EXPECT_EQ(hand(options(log))->failure(),
            log + ": log: found another server that is writing it, expected a log of its own for each server");
  EXPECT_THAT(first->stop(), HasSubstr("hand: messages: none"));
  const auto next = hand(options(log));
  EXPECT_TRUE(serves(log, std::filesystem::file_size(log)));
  EXPECT_THAT(next->told(), ElementsAre(HasSubstr("hand.jsonl: starts at its last state, of 20")));
}

TEST_F(DdsServer, TwoDoNotServeOneRobot) {
  const std::string log = path("hand.jsonl"), others = path("other.jsonl");
  const auto first = hand(options(log));
  ASSERT_TRUE(serves(log));
  EXPECT_THAT(hand(options(others, kFar))->failure(),
              AllOf(HasSubstr("DDS domain 8: rt/glovebench/joint_states: found another process that tells of rh_"),
                    HasSubstr("expected one server of a robot")));
  EXPECT_EQ(std::filesystem::file_size(others), 0U) << "it has served nothing";
  for (const bool with_hand : {false, true})  // the arm alone would share no factor with the hand
    EXPECT_THAT(arm(options(others, kFar), with_hand)->failure(), HasSubstr("expected one server of a robot"));
  EXPECT_THAT(first->stop(), testing::Not(HasSubstr("another server")));
}

TEST_F(DdsServer, TellsOfAnotherThatComesLater) {
  const std::string log = path("hand.jsonl");
  const auto server = hand(options(log));
  ASSERT_TRUE(serves(log));
  const DdsParticipant there(kFar);
  const DdsWriter<ros::JointState> writer(there, topics::kOwn.joint_states);
  const auto say = [&](const std::string& joint) { writer.write({{}, {joint}, {0}, {0}}, 1); };
  const auto told_of = [&](const std::string& joint) {
    return comes_true([&] {
      say(joint);
      return server->told().size() > 1;
    });
  };
  ASSERT_TRUE(comes_true([&] { return writer.listeners() > 0; }));
  for (int i = 0; i < 50; ++i) {
    say("drawer");
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_THAT(server->told(), ElementsAre(HasSubstr("starts at rest"))) << "not a joint of the robot";
  EXPECT_TRUE(told_of("rh_FFJ3"));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  say("rh_FFJ3");
  EXPECT_THAT(server->told(),
              ElementsAre(HasSubstr("starts at rest"), HasSubstr("hand: another process tells of rh_FFJ3, too")))
      << "once";
  EXPECT_THAT(server->stop(), HasSubstr("; another server: heard at "));
}

TEST_F(DdsServer, BelievesALogForATime) {
  const std::string log = path("hand.jsonl");
  std::vector<double> stood(kShadowJointCount, 0.0);
  stood[kFFJ3] = radians_from_degrees(30);
  const auto seconds_ago = [&](double seconds) {
    write_log(log, hand_joint_names(), stood, system_us() - static_cast<int64_t>(seconds * 1e6));
    return std::filesystem::file_size(log);
  };
  seconds_ago(kMaxLogAge + 60);
  EXPECT_THAT(hand(options(log))->failure(), AllOf(HasSubstr("hand.jsonl: last state: found one of 20"),
                                                   HasSubstr(" s ago, expected one of the last 600 s"),
                                                   HasSubstr("--log-age"), HasSubstr("another --log")));
  seconds_ago(-3600);
  EXPECT_THAT(hand(options(log))->failure(),
              AllOf(testing::ContainsRegex(" 3[56][0-9][0-9]\\.[0-9] s ahead"), HasSubstr("set the clock")));

  DdsServerOptions patient = options(log);
  patient.max_log_age_s = kMaxLogAge + 600;
  for (const DdsServerOptions& its : {options(log), patient}) {
    const size_t size = seconds_ago(its.max_log_age_s - 300);
    const auto server = hand(its);
    ASSERT_TRUE(serves(log, size)) << server->failure();
    EXPECT_THAT(server->told(), ElementsAre(HasSubstr(" ago")));
    server->stop();
    EXPECT_EQ(last_positions(log, hand_joint_names()), stood);
  }
}

TEST_F(DdsServer, DoesNotBelieveALogOfOtherJoints) {
  const std::string log = path("robot.jsonl");
  write_log(log, hand_joint_names(), std::vector<double>(kShadowJointCount, 0.0), system_us());
  EXPECT_EQ(arm(options(log), true)->failure(),
            log +
                ": last state: found no angle of S1, expected the 31 joints that are served, and no others. Look "
                "where the joints stand; if at rest: another --log");
  write_log(log, ServedRobot{true, MountedArm{}}.names(), std::vector<double>(31, 0.0), system_us());
  EXPECT_THAT(hand(options(log))->failure(), HasSubstr("last state: found 31 joints, expected the 24 joints"));
}

TEST_F(DdsServer, DoesNotBelieveALogThatLostItsEnd) {
  const std::string log = path("hand.jsonl");
  const int64_t time_us = system_us() - 100'000'000;
  write_log(log, hand_joint_names(), std::vector<double>(kShadowJointCount, 0.0), time_us);
  change_at(log, time_us + 20'000'000);
  EXPECT_THAT(hand(options(log))->failure(),
              AllOf(HasSubstr("hand.jsonl: last state: found one 20.0 s before the file was changed last"),
                    HasSubstr("another --log")));
}

TEST_F(DdsServer, WaitsForAMeasuredStateWhereTheLogIsNotSure) {
  const std::string log = path("hand.jsonl");
  const std::vector<std::string>& names = hand_joint_names();
  std::vector<double> low(kShadowJointCount, 0.0), high(kShadowJointCount, 0.0), measured(kShadowJointCount, 0.0);
  high[kFFJ3] = 1;
  measured[kFFJ3] = 0.7;
  measured[kMFJ3] = radians_from_degrees(90.5);  // a sensor's noise: moved onto the limit
  write_file(log, state_line({1, CommandState::following, low, {}}, system_us(), names) + "\n" +
                      interval_line({low, high}, system_us(), names) + "\n");
  const size_t size = std::filesystem::file_size(log);
  const auto server = hand(options(log));
  ASSERT_TRUE(comes_true([&] { return !server->told().empty(); })) << server->failure();
  EXPECT_THAT(server->told(), ElementsAre(AllOf(HasSubstr("the log says only within 57.3 degrees"),
                                                HasSubstr("waits for a measured state on rt/glovebench/"))));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(std::filesystem::file_size(log), size) << "it has not begun";

  const DdsParticipant there(kFar);
  const DdsWriter<ros::JointState> driver(there, topics::kMeasuredJointStates);
  EXPECT_TRUE(comes_true([&] {
    const int64_t now_us = system_us();
    driver.write({ros_time(now_us), names, measured, {}}, now_us * 1000);
    return has_state_after(log, size);
  }));
  server->stop();
  EXPECT_THAT(read_file(log), HasSubstr(R"("event":"start",)"));
  EXPECT_THAT(read_file(log), HasSubstr(R"("from":"measured")"));
  EXPECT_NEAR(last_positions(log, names)[kFFJ3], 0.7, 1e-7);
  EXPECT_NEAR(last_positions(log, names)[kMFJ3], radians_from_degrees(90), 1e-7);
  const auto again = hand(options(log));
  EXPECT_TRUE(serves(log, std::filesystem::file_size(log))) << "after a clean end the log is sure";
}

TEST_F(DdsServer, WaitsForTheArmsStateAndTheHands) {
  const std::string log = path("robot.jsonl");
  const ServedRobot both{true, MountedArm{}};
  write_file(log, state_line({1, CommandState::stopped, both.at_rest(), {}}, system_us(), both.names()) + "\n");
  const size_t size = std::filesystem::file_size(log);
  const auto server = arm(options(log), true);
  ASSERT_TRUE(comes_true([&] { return !server->told().empty(); })) << server->failure();
  const DdsParticipant there(kFar);
  const DdsWriter<ros::JointState> driver(there, topics::kMeasuredJointStates);
  const auto measure = [&](const std::vector<std::string>& names, const std::vector<double>& positions) {
    const int64_t now_us = system_us();
    driver.write({ros_time(now_us), names, positions, {}}, now_us * 1000);
  };
  const std::vector<double> rest(kArmAtRest.begin(), kArmAtRest.end());
  for (int i = 0; i < 50; ++i) {
    measure(arm_joint_names(), rest);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(std::filesystem::file_size(log), size) << "where the hand is nobody has said";
  EXPECT_TRUE(comes_true([&] {
    measure(hand_joint_names(), std::vector<double>(kShadowJointCount, 0.1));
    measure(arm_joint_names(), rest);
    return has_state_after(log, size);
  }));
  server->stop();
  EXPECT_NEAR(last_positions(log, both.names())[kFFJ3], 0.1, 1e-7);
  EXPECT_NEAR(last_positions(log, both.names()).back(), kArmAtRest.back(), 1e-7);
}

TEST_F(DdsServer, EndsWhileItWaitsForAMeasuredState) {
  const std::string log = path("hand.jsonl");
  write_file(log, state_line({1, CommandState::stopped, std::vector<double>(kShadowJointCount, 0.0), {}},
                             system_us(), hand_joint_names()) +
                      "\n");  // as an older version wrote it
  const auto server = hand(options(log));
  ASSERT_TRUE(comes_true([&] { return !server->told().empty(); }));
  EXPECT_EQ(server->stop(), "hand: ended before the joints were measured");
}

TEST_F(DdsServer, StartsAtALimitAndNotBeyond) {
  const std::string log = path("arm.jsonl");
  for (int j = 0; j < kArmJointCount; ++j) {
    const ArmJointInfo& info = arm_joint_infos()[j];
    if (info.name != "S1" && info.name != "S3" && info.name != "W2")
      continue;  // others take the wrist under the table
    for (const double angle_deg : {info.min_deg, info.max_deg}) {
      std::vector<double> stood(kArmAtRest.begin(), kArmAtRest.end());
      stood[static_cast<size_t>(j)] = radians_from_degrees(angle_deg);
      write_log(log, arm_joint_names(), stood, system_us());
      const auto server = arm(options(log));
      EXPECT_TRUE(serves(log, std::filesystem::file_size(log))) << server->failure();
    }
  }
  const std::vector<double> beyond(kArmJointCount, radians_from_degrees(256));
  write_log(log, arm_joint_names(), beyond, system_us());
  EXPECT_EQ(arm(options(log))->failure(), log + ": S1: found 256 degrees, expected -177 to 177");
}

}  // namespace
}  // namespace glovebench
