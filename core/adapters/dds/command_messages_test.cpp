#include "core/adapters/dds/command_messages.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/adapters/dds/server/test_messages.h"
#include "core/base/error.h"
#include "core/base/random.h"
#include "core/robot/command_guard.h"
#include "core/robot/shadow_kinematics.h"
#include "core/robot/test_commands.h"

namespace glovebench {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(CommandMessages, NameTheJointsAsTheControllersDo) {
  const std::vector<std::string>& names = hand_trajectory_names();
  EXPECT_EQ(names.size(), 22U);
  EXPECT_EQ(names.front(), "rh_FFJ1");
  EXPECT_THAT(names, testing::Not(testing::Contains(HasSubstr("WRJ"))));
  EXPECT_THAT(wrist_trajectory_names(), ElementsAre("rh_WRJ1", "rh_WRJ2"));
  EXPECT_EQ(hand_joint_names().size(), static_cast<size_t>(kShadowJointCount));
  EXPECT_EQ(arm_joint_names().size(), static_cast<size_t>(kArmJointCount));
}

TEST(CommandMessages, CarryTheTargets) {
  RobotCommand command = good_command(12'345'678);
  set_joint(*command.targets, kFFJ3, 0.5);
  set_joint(*command.targets, kWRJ2, -0.25);
  const ros::JointTrajectory hand = hand_message(command, 66'667), wrist = wrist_message(command, 66'667);
  EXPECT_EQ(hand.stamp.sec, 12);
  EXPECT_EQ(hand.stamp.nanosec, 345'678'000U);
  ASSERT_EQ(hand.points.size(), 1U);
  EXPECT_EQ(hand.points[0].time_from_start.nanosec, 66'667'000U);
  EXPECT_EQ(hand.points[0].positions[kFFJ3], 0.5);
  EXPECT_EQ(hand.joint_names[kFFJ3], "rh_FFJ3");
  EXPECT_THAT(wrist.points[0].positions, ElementsAre(0, -0.25));
}

/// A controller of joints that goes straight from where it is to the last targets, in the time that they give it.
class Controller {
 public:
  using Joints = std::array<double, kShadowJointCount>;
  explicit Controller(const Joints& at) : from_(at), to_(at) {}

  Joints at(int64_t now_us) const {
    const double share =
        std::clamp(static_cast<double>(now_us - begin_us_) / static_cast<double>(time_us_), 0.0, 1.0);
    Joints joints;
    for (size_t j = 0; j < joints.size(); ++j) joints[j] = from_[j] + share * (to_[j] - from_[j]);
    return joints;
  }
  /// Returns the largest speed of a joint on the new way, rad/s.
  double take(const RobotCommand& command, int64_t time_us) {
    const ros::JointTrajectory hand = hand_message(command, time_us), wrist = wrist_message(command, time_us);
    from_ = at(command.timestamp_us);
    std::ranges::copy(wrist.points[0].positions, std::ranges::copy(hand.points[0].positions, to_.begin()).out);
    begin_us_ = command.timestamp_us;
    time_us_ = nanoseconds(hand.points[0].time_from_start) / 1000;
    double farthest = 0;
    for (size_t j = 0; j < to_.size(); ++j) farthest = std::max(farthest, std::abs(to_[j] - from_[j]));
    return farthest / (static_cast<double>(time_us_) * 1e-6);
  }

 private:
  Joints from_, to_;
  int64_t begin_us_ = 0, time_us_ = 1;
};

/// The largest speed of a joint of a controller, rad/s. `gaps_us`: between commands, again and again; empty: random
/// ones, many of them shorter than a way and some of them pauses.
double fastest(const CommandLimits& limits, const std::vector<int64_t>& gaps_us) {
  RandomStream random(1, "controller", 0, "stamps");
  const RobotTargets start = *good_command(0).targets;
  CommandGuard guard(limits);
  guard.start_from(start);
  Controller controller(start.hand.joints);
  int64_t now_us = 1'000'000;
  double fastest = 0;
  for (size_t i = 0; i < 3000; ++i) {
    now_us += gaps_us.empty() ? 1 + static_cast<int64_t>(300'000 * std::pow(random.uniform(), 5))
                              : gaps_us[i % gaps_us.size()];
    if (i % 17 == 16) {
      guard.guard(lost_command(now_us));
      continue;
    }
    RobotCommand command = good_command(now_us);
    set_joint(*command.targets, kFFJ3, random.uniform() < 0.3 ? 0 : 1.5);
    set_joint(*command.targets, kWRJ1, random.uniform() < 0.5 ? -0.6 : 0.4);
    if (guard.state_at(now_us) != CommandState::following) {  // as `track` before a controller
      RobotTargets measured = start;
      measured.hand.joints = controller.at(now_us - kMeasuredAgeUs);
      make_actuators(measured.hand);
      guard.start_from(measured);
      guard.tick(now_us - 1);
    }
    if (const std::optional<RobotCommand> sent = guard.guard(command))
      fastest = std::max(fastest, controller.take(*sent, time_to_targets_us(limits.longest_step_s)));
  }
  return fastest;
}

TEST(CommandMessages, LeaveAControllerWithinTheLimitsWheneverTheyCome) {
  const std::vector<std::vector<int64_t>> streams = {
      {33'333}, {100'000, 1'000}, {500'000, 1, 1, 1, 1, 1, 1, 1, 1}, {2'000'000, 1'000, 140'000, 1'000}, {}};
  for (const double longest_step_s : {0.01, 0.1, 1.0}) {
    CommandLimits limits;
    limits.longest_step_s = longest_step_s;
    limits.fingertip_speed = 5;  // so that the joints' speed is what counts
    double of_all = 0;
    for (const std::vector<int64_t>& gaps_us : streams) {
      const double speed = fastest(limits, gaps_us);
      EXPECT_LE(speed, limits.hand_joint_speed * (1 + 1e-9)) << longest_step_s << testing::PrintToString(gaps_us);
      of_all = std::max(of_all, speed);
    }
    EXPECT_GE(of_all, limits.hand_joint_speed * 0.25) << "it does move";
  }
}

TEST(CommandMessages, TellTheArmWhereTheWristGoes) {
  RobotCommand command = good_command(12'345'678);
  set_joint(*command.targets, kWRJ1, 0.3);
  set_joint(*command.targets, kWRJ2, -0.2);
  command.targets->T_base_hand.linear() = Eigen::AngleAxisd(2, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  const ros::PoseStamped pose = pose_message(command);
  EXPECT_EQ(pose.frame_id, "base_link");
  EXPECT_EQ(pose.stamp.nanosec, 345'678'000U);
  EXPECT_GE(pose.qw, 0);
  const PoseRead read = read_pose(pose);
  ASSERT_EQ(read.receipt, Receipt::accepted);
  const Eigen::Isometry3d T_base_hand = read.T_base_wrist * shadow_T_wrist_hand(command.targets->hand.joints);
  EXPECT_TRUE(T_base_hand.isApprox(command.targets->T_base_hand, 1e-12)) << "conversions of a rotation";

  set_joint(*command.targets, kWRJ1, 0);
  set_joint(*command.targets, kWRJ2, 0);
  command.targets->T_base_hand = Eigen::Translation3d(0.5, 0, 0.5);
  const ros::PoseStamped straight = pose_message(command);
  // 34 mm from WRJ2 to WRJ1, and half of the way from there to the middle knuckle, 99 mm, along the hand's -z.
  EXPECT_NEAR(straight.z - 0.5, 0.034 + 0.099 / 2, 2e-3);
}

TEST(CommandMessages, ComeBackAsTheyWere) {
  RobotCommand command = good_command(1);
  for (int j = 0; j < kShadowJointCount; ++j) set_joint(*command.targets, static_cast<ShadowJoint>(j), 0.01 * j);
  const JointsRead fingers = read_joints(hand_message(command, 1000), hand_trajectory_names());
  const JointsRead wrist = read_joints(wrist_message(command, 1000), wrist_trajectory_names());
  ASSERT_EQ(fingers.receipt, Receipt::accepted);
  ASSERT_EQ(wrist.receipt, Receipt::accepted);
  for (int j = 0; j < kWRJ1; ++j) EXPECT_EQ(fingers.positions[static_cast<size_t>(j)], 0.01 * j);
  EXPECT_THAT(wrist.positions, ElementsAre(0.01 * 22, 0.01 * 23));
}

TEST(CommandMessages, AreNotMadeOfWhatRosCannotSay) {
  RobotCommand command = good_command(1);
  command.targets->hand.joints[kMFJ2] = kNan;
  EXPECT_THROW(hand_message(command, 1000), Error);
  command.targets->T_base_hand.translation().z() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(pose_message(command), Error);
  EXPECT_THROW(ros_time(-1), Error);
  EXPECT_THROW(ros_time(int64_t{1} << 60), Error);
  EXPECT_EQ(ros_time(2'147'483'647'999'999).sec, 2'147'483'647);
}

TEST(CommandMessages, MayNameTheJointsInAnyOrder) {
  ros::JointTrajectory message = trajectory_message(wrist_trajectory_names(), 0, 1);
  std::swap(message.joint_names[0], message.joint_names[1]);
  message.points[0].positions = {0.1, 0.2};
  EXPECT_THAT(read_joints(message, wrist_trajectory_names()).positions, ElementsAre(0.2, 0.1));
}

TEST(CommandMessages, OfWrongJointsAreRefused) {
  const std::vector<std::string>& names = hand_trajectory_names();
  const auto receipt = [&](const ros::JointTrajectory& message) { return read_joints(message, names).receipt; };
  ros::JointTrajectory message = trajectory_message(names, 5, 1);
  EXPECT_EQ(receipt(message), Receipt::accepted);
  message.joint_names[3] = "lh_FFJ4";
  EXPECT_EQ(receipt(message), Receipt::wrong_joints);
  message.joint_names[3] = message.joint_names[4];
  EXPECT_EQ(receipt(message), Receipt::wrong_joints) << "one twice, one missing";
  message = trajectory_message(hand_joint_names(), 5, 1);
  EXPECT_EQ(receipt(message), Receipt::wrong_joints) << "with the wrist";
  EXPECT_EQ(receipt(ros::JointTrajectory()), Receipt::wrong_joints);
}

TEST(CommandMessages, OfWrongPointsAreRefused) {
  const std::vector<std::string>& names = wrist_trajectory_names();
  const ros::JointTrajectory good = trajectory_message(names, 5, 1);
  const auto receipt_of = [&](const auto& change) {
    ros::JointTrajectory message = good;
    change(message);
    return read_joints(message, names).receipt;
  };
  EXPECT_EQ(receipt_of([](auto& m) { m.points.clear(); }), Receipt::wrong_points);
  EXPECT_EQ(receipt_of([](auto& m) { m.points.push_back(m.points[0]); }), Receipt::wrong_points);
  EXPECT_EQ(receipt_of([](auto& m) { m.points[0].positions.pop_back(); }), Receipt::wrong_points);
  EXPECT_EQ(receipt_of([](auto& m) { m.points[0].positions.push_back(0); }), Receipt::wrong_points);
  EXPECT_EQ(receipt_of([](auto& m) { m.points[0].positions[1] = kNan; }), Receipt::not_finite);
  EXPECT_EQ(receipt_of([](auto& m) { m.stamp.sec = -1; }), Receipt::bad_time);
  EXPECT_EQ(receipt_of([](auto& m) { m.stamp.nanosec = 1'000'000'000; }), Receipt::bad_time);
  EXPECT_EQ(receipt_of([](auto& m) { m.points[0].time_from_start.sec = -1; }), Receipt::bad_time);
}

TEST(CommandMessages, OfWrongPosesAreRefused) {
  const auto receipt_of = [](const auto& change) {
    ros::PoseStamped message = pose_at(0.5, 0, 0.5, 1);
    change(message);
    return read_pose(message).receipt;
  };
  EXPECT_EQ(receipt_of([](auto&) {}), Receipt::accepted);
  EXPECT_EQ(receipt_of([](auto& m) { m.frame_id = "camera"; }), Receipt::wrong_frame);
  EXPECT_EQ(receipt_of([](auto& m) { m.frame_id = ""; }), Receipt::wrong_frame);
  EXPECT_EQ(receipt_of([](auto& m) { m.y = kNan; }), Receipt::not_finite);
  EXPECT_EQ(receipt_of([](auto& m) { m.qz = kNan; }), Receipt::not_finite);
  EXPECT_EQ(receipt_of([](auto& m) { m.qw = 0; }), Receipt::not_rotation);
  EXPECT_EQ(receipt_of([](auto& m) { m.qx = 1e300; }), Receipt::not_rotation);
  EXPECT_EQ(receipt_of([](auto& m) { m.stamp.sec = -5; }), Receipt::bad_time);
}

}  // namespace
}  // namespace glovebench
