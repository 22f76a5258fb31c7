// Servers of the arm alone.
#include "core/adapters/dds/server/robot_server.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/adapters/dds/server/test_messages.h"
#include "core/base/error.h"
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/test_error.h"

namespace glovebench {
namespace {

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

ServedRobot arm_of(const ArmSolver& solver, const Eigen::Isometry3d& T_flange_wrist) {
  return {false, MountedArm{&solver, T_flange_wrist}};
}

class RobotServerArm : public testing::Test {
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

TEST_F(RobotServerArm, FollowsThePoseOfTheWrist) {
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

TEST_F(RobotServerArm, HoldsAndStopsOnTheWay) {
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

TEST_F(RobotServerArm, StaysWhereThePoseIsOutOfReach) {
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

TEST_F(RobotServerArm, MovesNoFasterThanTheHandMayWhateverTheSolverSays) {
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

TEST_F(RobotServerArm, StaysInTheWorkspaceWhenItHasToCatchUp) {
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

TEST_F(RobotServerArm, AGapOrALogThatWaitsHoldsIt) {
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

TEST_F(RobotServerArm, RefusesOtherFrames) {
  tick(server_);
  ros::PoseStamped message = displaced({0, 0.1, 0}, 1);
  message.frame_id = "world";
  EXPECT_EQ(receive(server_, message), Receipt::wrong_frame);
  EXPECT_EQ(tick(server_).position, kStart);
  EXPECT_EQ(server_.stream().count(Receipt::wrong_frame), 1);
}

/// What a log makes of an angle.
double logged(double angle) { return radians_from_degrees(std::round(degrees_from_radians(angle) * 1e6) / 1e6); }

TEST(RobotServerArmStart, StartsAtALimitOfAJoint) {
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

TEST(RobotServerArmStart, StartsAtTheEdgeOfTheWorkspace) {
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
    EXPECT_THAT(thrown_by([&] {
                  RobotServer(outside_by(1e-3), arm_of(solver, mounted), {start, "arm.jsonl"});
                }),
                testing::MatchesRegex("arm.jsonl: wrist of the arm: found \\(.*\\) m, expected a place in "
                                      "the workspace, with room for the fingertips: \\(-1.27 -1.27 0.23\\) to "
                                      "\\(.*\\)"))
        << axis;
  }
}

TEST(RobotServerArmStart, StartsWhereTheJointsStandIfThatIsAPlace) {
  const JacobianSolver solver;
  const Eigen::Isometry3d mounted = Eigen::Isometry3d::Identity();
  EXPECT_EQ(RobotServer({}, arm_of(solver, mounted), {kStart}).tick({1, 1}).position, kStart);
  EXPECT_THROW(RobotServer({}, arm_of(solver, mounted), {{0, 2, 0, 0, 0, 0, 0}}), Error) << "115 degrees, of 94";
  EXPECT_THROW(RobotServer({}, arm_of(solver, mounted), {{0, 1.6, 0, 1, 0, 0, 0}}), Error)
      << "the wrist under the table";
  EXPECT_THROW(RobotServer({}, arm_of(solver, mounted), {{std::nan(""), 0, 0, 0, 0, 0, 0}}), Error);
  EXPECT_THROW(RobotServer({}, arm_of(solver, mounted), {{0, 0}}), Error);
}

}  // namespace
}  // namespace glovebench
