// Servers of the arm alone, and of hand and arm together.
#include "core/robot/server/robot_server.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "core/base/angles.h"
#include "core/base/error.h"
#include "core/base/random.h"
#include "core/robot/server/test_messages.h"
#include "core/robot/shadow_kinematics.h"
#include "core/robot/test_arm_solver.h"
#include "core/robot/test_fingertips.h"

namespace glovebench {
namespace {

constexpr int64_t kArmPeriodUs = 10'000;
constexpr uint64_t kSender = 3;
constexpr double kArmRounding = 1e-9;  // of a pose that went through seven rotations

/// Flips the elbow all the time, as no solver should.
class FlippingSolver : public ArmSolver {
 public:
  std::optional<ArmJoints> solve(const Eigen::Isometry3d&, const ArmJoints& start) const override {
    ArmJoints joints = start;
    joints[1] = -std::copysign(1.2, start[1]);
    joints[3] = -std::copysign(1.2, start[3]);
    joints[6] = 3;
    return joints;
  }
};

const std::vector<double> kStart = {0, 0.5, 0, 1.5, 0, 0.8, 0};

/// Where the wrist is by the joints of an arm.
Eigen::Isometry3d wrist_of(const std::vector<double>& positions, const Eigen::Isometry3d& T_flange_wrist) {
  ArmJoints joints;
  std::copy_n(positions.end() - kArmJointCount, kArmJointCount, joints.begin());
  return arm_flange_pose(joints) * T_flange_wrist;
}

ServedRobot arm_of(const ArmSolver& solver, const Eigen::Isometry3d& T_flange_wrist) {
  return {false, MountedArm{&solver, T_flange_wrist}};
}

class ArmServerTest : public testing::Test {
 protected:
  Eigen::Isometry3d wrist(const RobotServer& server) const { return wrist_of(server.positions(), T_flange_wrist_); }
  RobotState tick(RobotServer& server) {
    const Eigen::Isometry3d before = wrist(server);
    now_us_ += kArmPeriodUs;
    const RobotState state = server.tick({now_us_, now_us_});
    const Eigen::Isometry3d after = wrist(server);
    const double seconds = kArmPeriodUs * 1e-6;
    EXPECT_LE((after.translation() - before.translation()).norm(), limits_.hand_speed * seconds + kArmRounding);
    EXPECT_LE(Eigen::Quaterniond(before.linear()).angularDistance(Eigen::Quaterniond(after.linear())),
              limits_.hand_turn_speed * seconds + kArmRounding);
    // A fingertip may be anywhere within 0.23 m of the wrist.
    RandomStream random(1, "arm", now_us_, "fingertips");
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d tip =
          0.23 * Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
      EXPECT_LE((after * tip - before * tip).norm(), 0.5 * seconds + kArmRounding);
      EXPECT_GE(((after * tip) - limits_.workspace_min).minCoeff(), -1e-4);
      EXPECT_GE((limits_.workspace_max - after * tip).minCoeff(), -1e-4);
    }
    for (int j = 0; j < kArmJointCount; ++j) {
      EXPECT_LE(std::abs(state.position[j] - last_[j]),
                radians_from_degrees(arm_joint_infos()[j].max_speed_deg_s) * seconds + kArmRounding);
    }
    last_ = state.position;
    return state;
  }
  Receipt receive(RobotServer& server, const ros::PoseStamped& message) const {
    return server.receive(RobotTopic::pose, message, {kSender, now_us_ * 1000, now_us_});
  }
  /// After that the next message is accepted.
  void start(RobotServer& server) {
    for (int i = 0; i < 20; ++i) {
      tick(server);
      EXPECT_EQ(receive(server, displaced({0, 0, 0}, 0)), Receipt::starting);
    }
    tick(server);
  }
  ros::PoseStamped displaced(const Eigen::Vector3d& way, int64_t stamp_us) const {
    const Eigen::Vector3d p = T_start_.translation() + way;
    const Eigen::Quaterniond q(T_start_.linear());
    ros::PoseStamped message = pose_at(p.x(), p.y(), p.z(), stamp_us);
    message.qx = q.x(), message.qy = q.y(), message.qz = q.z(), message.qw = q.w();
    return message;
  }

  CommandLimits limits_;
  JacobianSolver solver_;
  Eigen::Isometry3d T_flange_wrist_ = Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.1));
  RobotServer server_{limits_, arm_of(solver_, T_flange_wrist_), {kStart}};
  Eigen::Isometry3d T_start_ = wrist(server_);
  int64_t now_us_ = 1'000'000;
  std::vector<double> last_ = kStart;
};

TEST_F(ArmServerTest, FollowsThePoseOfTheWrist) {
  start(server_);
  int ticks = 0;
  const Eigen::Vector3d way(0.03, -0.1, 0.04);
  for (; ticks < 300 && (wrist(server_).translation() - T_start_.translation() - way).norm() > 1e-6; ++ticks) {
    EXPECT_EQ(receive(server_, displaced(way, now_us_)), Receipt::accepted);
    EXPECT_EQ(tick(server_).state, CommandState::following);
  }
  EXPECT_EQ(ticks, std::ceil(way.norm() / limits_.hand_speed * 100)) << "as fast as the hand may move";
  EXPECT_TRUE(wrist(server_).linear().isApprox(T_start_.linear(), 1e-6));
}

TEST_F(ArmServerTest, HoldsAndStopsOnTheWay) {
  start(server_);
  EXPECT_EQ(receive(server_, displaced({0, 0.2, 0}, 1)), Receipt::accepted);
  for (int i = 0; i < 15; ++i) EXPECT_EQ(tick(server_).state, CommandState::following);
  tick(server_);
  const RobotState held = tick(server_);
  EXPECT_EQ(held.state, CommandState::holding);
  for (int i = 0; i < 40; ++i) tick(server_);
  EXPECT_EQ(tick(server_).state, CommandState::stopped);
  EXPECT_EQ(last_, held.position);
}

TEST_F(ArmServerTest, StaysWhereThePoseIsOutOfReach) {
  start(server_);
  for (int i = 1; i < 900; ++i) {
    EXPECT_EQ(receive(server_, displaced({1e3, 0, 0}, i)), Receipt::accepted);
    tick(server_);
  }
  EXPECT_GT(server_.interventions()[Intervention::arm_unreachable], 0);
  EXPECT_GT(server_.interventions()[Intervention::workspace], 0);
  const std::vector<double> stuck = last_;
  EXPECT_EQ(tick(server_).position, stuck);
  for (int i = 1000; i < 3000; ++i) {
    receive(server_, displaced({0, 0, 0}, i));
    tick(server_);
  }
  EXPECT_LT((wrist(server_).translation() - T_start_.translation()).norm(), 1e-6) << "and it comes back";
}

TEST_F(ArmServerTest, MovesNoFasterThanTheHandMayWhateverTheSolverSays) {
  const FlippingSolver flipping;
  RobotServer server(limits_, arm_of(flipping, T_flange_wrist_), {kStart});
  start(server);
  for (int i = 1; i < 300; ++i) {
    receive(server, displaced({0, 0, 0}, i));
    tick(server);  // checks it
  }
  EXPECT_NE(last_, kStart);
  EXPECT_GT(
      server.interventions()[Intervention::hand_speed] + server.interventions()[Intervention::hand_turn_speed], 0);
}

/// Finds nothing until it is told to.
class SleepingSolver : public JacobianSolver {
 public:
  std::optional<ArmJoints> solve(const Eigen::Isometry3d& T_base_flange, const ArmJoints& start) const override {
    return asleep ? std::nullopt : JacobianSolver::solve(T_base_flange, start);
  }
  bool asleep = true;
};

TEST_F(ArmServerTest, StaysInTheWorkspaceWhenItHasToCatchUp) {
  limits_.workspace_max.x() = T_start_.translation().x() + 0.23;
  SleepingSolver solver;
  RobotServer server(limits_, arm_of(solver, T_flange_wrist_), {kStart});
  start(server);
  const Eigen::Vector3d way(0, 0.4, 0);
  for (int i = 1; i < 800; ++i) {
    solver.asleep = i < 200;  // meanwhile the pose goes there
    receive(server, displaced(way, i));
    tick(server);
    EXPECT_LE(wrist(server).translation().x(), limits_.workspace_max.x() - 0.23 + 1e-4) << i;
  }
  EXPECT_EQ(server.interventions()[Intervention::arm_unreachable], 199);
  EXPECT_LT((wrist(server).translation() - T_start_.translation() - way).norm(), 1e-3) << "and it gets there";
}

TEST_F(ArmServerTest, AGapOrALogThatWaitsHoldsIt) {
  start(server_);
  for (int i = 1; i <= 10; ++i, tick(server_))
    EXPECT_EQ(receive(server_, displaced({0, 0.2, 0}, i)), Receipt::accepted);
  const std::vector<double> stood = last_;
  now_us_ += kArmPeriodUs;
  EXPECT_EQ(receive(server_, displaced({0, 0.2, 0}, 11)), Receipt::accepted);
  EXPECT_EQ(server_.tick({now_us_, now_us_}, false).position, stood);
  tick(server_);
  EXPECT_NE(last_, stood) << "without another message";
  const std::vector<double> next = last_;
  now_us_ += 95'000;
  EXPECT_EQ(receive(server_, displaced({0, 0.2, 0}, 12)), Receipt::accepted);
  for (int i = 0; i < 30; ++i) {
    tick(server_);
    EXPECT_EQ(last_, next);
    EXPECT_NE(receive(server_, displaced({0, 0.2, 0}, 13)), Receipt::accepted);
  }
  tick(server_);
  EXPECT_EQ(receive(server_, displaced({0, 0.2, 0}, 13)), Receipt::accepted);
}

TEST_F(ArmServerTest, RefusesOtherFrames) {
  tick(server_);
  ros::PoseStamped message = displaced({0, 0.1, 0}, 1);
  message.frame_id = "world";
  EXPECT_EQ(receive(server_, message), Receipt::wrong_frame);
  EXPECT_EQ(tick(server_).position, kStart);
  EXPECT_EQ(server_.stream().count(Receipt::wrong_frame), 1);
}

/// What a log makes of an angle.
double logged(double angle) {
  return radians_from_degrees(std::round(degrees_from_radians(angle) * 1e6) / 1e6);
}

TEST(ArmServer, StartsAtALimitOfAJoint) {
  const JacobianSolver solver;
  const Eigen::Isometry3d mounted = Eigen::Isometry3d::Identity();
  CommandLimits everywhere;
  everywhere.workspace_min.setConstant(-3);
  everywhere.workspace_max.setConstant(3);
  for (int j = 0; j < kArmJointCount; ++j) {
    for (const double limit_deg : {arm_joint_infos()[j].min_deg, arm_joint_infos()[j].max_deg}) {
      const double outwards = std::copysign(1, limit_deg), limit = radians_from_degrees(limit_deg);
      std::vector<double> start = kStart;
      for (const double angle :
           {limit, logged(limit), std::nextafter(limit, outwards * 10), limit + outwards * 1e-8}) {
        start[j] = angle;
        EXPECT_EQ(RobotServer(everywhere, arm_of(solver, mounted), {start}).tick({1, 1}).position[j], limit)
            << arm_joint_infos()[j].name;
      }
      start[j] = limit + outwards * 1e-6;
      EXPECT_THROW(RobotServer(everywhere, arm_of(solver, mounted), {start}), Error) << arm_joint_infos()[j].name;
    }
  }
}

TEST(ArmServer, StartsAtTheEdgeOfTheWorkspace) {
  const JacobianSolver solver;
  const Eigen::Isometry3d mounted(Eigen::Translation3d(0, 0, 0.1));
  std::vector<double> start = kStart;
  for (double& angle : start) angle = logged(angle + 1e-7);
  ArmJoints joints;
  std::ranges::copy(start, joints.begin());
  const Eigen::Vector3d p = (arm_flange_pose(joints) * mounted).translation();
  for (int axis = 0; axis < 3; ++axis) {
    CommandLimits limits;
    const auto outside_by = [&](double distance) {
      limits.workspace_max[axis] = p[axis] + 0.23 - distance;
      return limits;
    };
    for (const double rounding : {0.0, 1e-7, 2e-5}) {  // of the log, of inverse kinematics
      RobotServer server(outside_by(rounding), arm_of(solver, mounted), {start});
      EXPECT_EQ(server.tick({1, 1}).position, start);
      ros::PoseStamped message = pose_at(p.x() - 0.05, p.y() - 0.05, p.z() - 0.05, 1);
      const Eigen::Quaterniond q(wrist_of(server.positions(), mounted).linear());
      message.qx = q.x(), message.qy = q.y(), message.qz = q.z(), message.qw = q.w();
      int64_t now_us = 1;
      for (int i = 0; i <= 20; ++i) {
        now_us += kArmPeriodUs;
        message.stamp = test_stamp(now_us);
        server.receive(RobotTopic::pose, message, {kSender, now_us * 1000, now_us});
        server.tick({now_us + 1, now_us + 1});
      }
      EXPECT_EQ(server.tick({now_us + 2, now_us + 2}).state, CommandState::following) << "and goes on from there";
      EXPECT_LT(wrist_of(server.positions(), mounted).translation()[axis], p[axis]);
    }
    try {
      RobotServer(outside_by(1e-3), arm_of(solver, mounted), {start, "arm.jsonl"});
      ADD_FAILURE() << axis;
    } catch (const Error& e) {
      EXPECT_THAT(e.what(),
                  testing::MatchesRegex("arm.jsonl: wrist of the arm: found \\(.*\\) m, expected a place in "
                                        "the workspace, with room for the fingertips: \\(-1.27 -1.27 0.23\\) to "
                                        "\\(.*\\)"));
    }
  }
}

TEST(ArmServer, StartsWhereTheJointsStandIfThatIsAPlace) {
  const JacobianSolver solver;
  const Eigen::Isometry3d mounted = Eigen::Isometry3d::Identity();
  EXPECT_EQ(RobotServer({}, arm_of(solver, mounted), {kStart}).tick({1, 1}).position, kStart);
  EXPECT_THROW(RobotServer({}, arm_of(solver, mounted), {{0, 2, 0, 0, 0, 0, 0}}), Error) << "115 degrees, of 94";
  EXPECT_THROW(RobotServer({}, arm_of(solver, mounted), {{0, 1.6, 0, 1, 0, 0, 0}}), Error)
      << "the wrist under the table";
  EXPECT_THROW(RobotServer({}, arm_of(solver, mounted), {{std::nan(""), 0, 0, 0, 0, 0, 0}}), Error);
  EXPECT_THROW(RobotServer({}, arm_of(solver, mounted), {{0, 0}}), Error);
}

/// Hand and arm in one server. Every tick is checked in the arm's base frame, by kinematics of the fingers that are
/// not the library's.
class HandAndArmTest : public testing::Test {
 protected:
  TestFingertips::Tips tips(const std::vector<double>& positions) const {
    std::array<double, kShadowJointCount> joints;
    std::copy_n(positions.begin(), kShadowJointCount, joints.begin());
    const Eigen::Isometry3d T_base_wrist = wrist_of(positions, T_flange_wrist_);
    return (T_base_wrist.linear() * TestFingertips(joints).in_forearm()).colwise() + T_base_wrist.translation();
  }
  Eigen::Isometry3d hand_of(const std::vector<double>& positions) const {
    std::array<double, kShadowJointCount> joints;
    std::copy_n(positions.begin(), kShadowJointCount, joints.begin());
    return wrist_of(positions, T_flange_wrist_) * shadow_T_wrist_hand(joints);
  }
  RobotState tick() {
    now_us_ += kArmPeriodUs;
    const RobotState state = server_->tick({now_us_, now_us_});
    constexpr double kSeconds = kArmPeriodUs * 1e-6;
    const TestFingertips::Tips before = tips(last_), after = tips(state.position);
    const double way = (after - before).colwise().norm().maxCoeff();
    EXPECT_LE(way, limits_.fingertip_speed * kSeconds + kArmRounding);
    fastest_ = std::max(fastest_, way / kSeconds);
    EXPECT_GE((after.colwise() - limits_.workspace_min).minCoeff(), -1e-4);
    EXPECT_LE((after.colwise() - limits_.workspace_max).maxCoeff(), 1e-4);
    const Eigen::Isometry3d T_before = hand_of(last_), T_after = hand_of(state.position);
    EXPECT_LE((T_after.translation() - T_before.translation()).norm(),
              limits_.hand_speed * kSeconds + kArmRounding);
    EXPECT_LE(Eigen::Quaterniond(T_before.linear()).angularDistance(Eigen::Quaterniond(T_after.linear())),
              limits_.hand_turn_speed * kSeconds + kArmRounding);
    const std::vector<JointMotion> motions = robot_.motions(limits_);
    for (size_t j = 0; j < motions.size(); ++j) {
      EXPECT_LE(std::abs(state.position[j] - last_[j]), motions[j].speed * kSeconds + kArmRounding) << j;
      EXPECT_GE(state.position[j], motions[j].min);
      EXPECT_LE(state.position[j], motions[j].max);
    }
    last_ = state.position;
    return state;
  }
  Receipt fingers(double angle_deg) {
    return send(RobotTopic::fingers, trajectory_message(hand_trajectory_names(), angle_deg, now_us_));
  }
  Receipt wrist(double angle_deg) {
    return send(RobotTopic::wrist, trajectory_message(wrist_trajectory_names(), angle_deg, now_us_));
  }
  Receipt pose(const Eigen::Isometry3d& T_base_wrist) {
    const Eigen::Vector3d p = T_base_wrist.translation();
    const Eigen::Quaterniond q(T_base_wrist.linear());
    ros::PoseStamped message = pose_at(p.x(), p.y(), p.z(), now_us_);
    message.qx = q.x(), message.qy = q.y(), message.qz = q.z(), message.qw = q.w();
    return send(RobotTopic::pose, message);
  }
  Receipt pose(double x, double y, double z) { return pose(Eigen::Translation3d(x, y, z) * T_start_); }
  template <typename Message>
  Receipt send(RobotTopic topic, const Message& message) {
    return server_->receive(topic, message, {kSender, now_us_ * 1000, now_us_});
  }
  /// After that the next messages are accepted.
  void start() {
    server_.emplace(limits_, robot_, StartPlace{last_});
    for (int i = 0; i < 20; ++i) {
      tick();
      fingers(0), wrist(0), pose(0, 0, 0);
    }
    tick();
  }

  CommandLimits limits_;
  SleepingSolver solver_;
  Eigen::Isometry3d T_flange_wrist_ = default_T_flange_wrist();
  ServedRobot robot_{true, MountedArm{&solver_, T_flange_wrist_}};
  std::vector<double> last_ = robot_.at_rest();
  Eigen::Isometry3d T_start_ = wrist_of(last_, T_flange_wrist_);
  std::optional<RobotServer> server_;
  int64_t now_us_ = 1'000'000;
  double fastest_ = 0;  ///< of the fingertips, m/s
};

TEST_F(HandAndArmTest, FingertipsKeepTheirSpeedInTheBaseFrame) {
  solver_.asleep = false;
  start();
  for (int i = 0; i < 300; ++i) {  // to and fro: fingers, wrist and arm all that way
    const bool there = i / 60 % 2 == 0;
    fingers(there ? 80 : 0), wrist(there ? 25 : -25);
    pose(there ? -0.2 : 0, there ? 0.2 : 0, there ? 0.1 : 0);
    tick();  // checks it
  }
  RandomStream random(1, "hand and arm", 0, "goals");
  for (int i = 0; i < 40; ++i) {
    const double bend = 45 + 45 * random.normal(), turn = 20 * random.normal();
    const Eigen::Isometry3d goal = Eigen::Translation3d(0.1 * random.normal(), 0.2 * random.normal(), 0) *
                                   T_start_ * Eigen::AngleAxisd(0.3 * random.normal(), Eigen::Vector3d::UnitX());
    for (int k = 0; k < 15; ++k) {
      fingers(bend), wrist(turn), pose(goal);
      tick();
    }
  }
  EXPECT_GT(fastest_, 0.99 * limits_.fingertip_speed) << "and they use it";
  EXPECT_GT(server_->interventions()[Intervention::fingertip_speed], 100);
}

TEST_F(HandAndArmTest, OneFactorSlowsAllJointsDown) {
  solver_.asleep = false;
  start();
  const Eigen::Vector3d before = hand_of(last_).translation(), way(-0.1, 0.2, 0.05);
  fingers(80), pose(way.x(), way.y(), way.z());
  tick();
  const double share = last_[kFFJ3] / radians_from_degrees(80);
  EXPECT_GT(share, 1e-3);
  EXPECT_LT(share, 0.05);
  const Eigen::Vector3d moved = hand_of(last_).translation() - before;
  EXPECT_LT((moved - share * way).norm(), 1e-3 * share * way.norm()) << "a step along the arm's curve";
}

TEST_F(HandAndArmTest, WhoIsNotCommandedStays) {
  solver_.asleep = false;
  start();
  std::vector<double> at_start = last_;
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(fingers(80), Receipt::accepted);
    EXPECT_EQ(wrist(20), Receipt::accepted);
    EXPECT_EQ(tick().state, CommandState::following);
  }
  EXPECT_GT(last_[kFFJ3], 0.4);
  EXPECT_TRUE(std::equal(last_.end() - kArmJointCount, last_.end(), at_start.end() - kArmJointCount)) << "the arm";
  for (int i = 0; i < 50; ++i) tick();
  at_start = last_;
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(pose(0, 0.1, 0), Receipt::accepted);
    tick();
  }
  EXPECT_NE(last_.back(), at_start.back());
  EXPECT_TRUE(std::equal(at_start.begin(), at_start.end() - kArmJointCount, last_.begin())) << "the hand";
}

TEST_F(HandAndArmTest, FingersGoOnWhereTheArmReachesNothing) {
  start();
  for (int i = 0; i < 100; ++i) {
    fingers(30), pose(0, 0.1, 0);
    tick();
  }
  EXPECT_NEAR(last_[kFFJ3], radians_from_degrees(30), kArmRounding);
  EXPECT_EQ(server_->interventions()[Intervention::arm_unreachable], 100);
  EXPECT_EQ(wrist_of(last_, T_flange_wrist_).matrix(), T_start_.matrix());
}

TEST_F(HandAndArmTest, NoFingertipLeavesTheWorkspaceHoweverTheHandIsBent) {
  solver_.asleep = false;
  for (int i = 0; i < kShadowJointCount; ++i) last_[i] = 0;
  for (const int j3 : {kFFJ3, kMFJ3, kRFJ3, kLFJ3}) last_[j3] = radians_from_degrees(90);
  const double lowest = tips(last_).row(2).minCoeff(), highest = tips(last_).row(2).maxCoeff();
  last_ = robot_.at_rest();
  // Bent fingers would be out below or above, whichever way they bend.
  const TestFingertips::Tips straight = tips(last_);
  const bool down = straight.row(2).minCoeff() - lowest > highest - straight.row(2).maxCoeff();
  if (down) {
    limits_.workspace_min.z() = straight.row(2).minCoeff() - 0.02;
  } else {
    limits_.workspace_max.z() = straight.row(2).maxCoeff() + 0.02;
  }
  start();
  for (int i = 0; i < 100; ++i) {
    fingers(90);
    tick();  // checks it
  }
  EXPECT_GT(last_[kMFJ3], 0.05);
  EXPECT_LT(last_[kMFJ3], radians_from_degrees(80)) << "held at the face";
  EXPECT_GT(server_->interventions()[Intervention::workspace], 0);
  EXPECT_EQ(wrist_of(last_, T_flange_wrist_).matrix(), T_start_.matrix());
  for (int i = 0; i < 300; ++i) {
    fingers(90), pose(0, 0, 0);
    tick();
  }
  EXPECT_NEAR(last_[kMFJ3], radians_from_degrees(90), 1e-6) << "an arm that may move takes the hand aside";
  EXPECT_GT((wrist_of(last_, T_flange_wrist_).translation() - T_start_.translation()).norm(), 0.005);
}

TEST_F(HandAndArmTest, OneSenderOwnsHandAndArm) {
  start();
  EXPECT_EQ(fingers(10), Receipt::accepted);
  const ros::PoseStamped other = pose_at(0.5, 0, 0.5, now_us_);
  EXPECT_EQ(server_->receive(RobotTopic::pose, other, {kSender + 1, now_us_ * 1000, now_us_}), Receipt::foreign);
}

TEST_F(HandAndArmTest, StartsWithItsFingertipsInTheWorkspace) {
  const Eigen::Vector3d highest = tips(last_).rowwise().maxCoeff();
  limits_.workspace_max.z() = std::max(highest.z(), hand_of(last_).translation().z()) + 1e-3;
  EXPECT_NO_THROW(RobotServer(limits_, robot_, {last_}));
  limits_.workspace_max.z() -= 3e-3;
  try {
    RobotServer(limits_, robot_, {last_, "robot.jsonl"});
    ADD_FAILURE();
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), testing::StartsWith("robot.jsonl: hand on the arm: found ("));
  }
}

}  // namespace
}  // namespace glovebench
