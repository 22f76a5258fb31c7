#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/adapters/dds/server/command_messages.h"
#include "core/adapters/dds/server/command_stream.h"
#include "core/adapters/dds/server/stated_interval.h"
#include "core/base/math.h"
#include "core/robot/command_guard.h"

namespace glovebench {

// The way of one message:
//
//   received   RobotServer::receive gets it, with who sent it and when (Arrival).
//   judged     Is its sender the owner? Is it good in itself (read_joints, read_pose), fresh, in time order
//              (CommandStream)? The answer is its Receipt. All but `accepted` is as if it had not come.
//   followed   The joints or the pose of its topic become the goal. Of several between two ticks the last counts.
//   limited    A tick moves towards the goal, by one factor for all joints, no farther than CommandGuard allows.
//   stated     The log says on the disk where the joints may be (MotionLog); a tick before that holds.
//   sent       The RobotState of the tick goes to the joints (core/adapters/dds/dds_server.cpp).

/// Topics of a robot: fingers and wrist are the hand's, the pose of the wrist is the arm's.
enum class RobotTopic { fingers, wrist, pose };
inline constexpr int kRobotTopicCount = 3;
std::string_view to_string(RobotTopic topic);

/// Which joints a server has: those of the hand, of the arm, or both.
struct ServedRobot {
  bool hand = true;
  std::optional<MountedArm> arm = std::nullopt;

  GuardedPart part() const;
  std::string name() const;  ///< "hand", "arm" or "hand and arm"
  /// Of its joints, as all that follows: the hand's in the order of ShadowJoint, then the arm's.
  std::vector<std::string> names() const;
  std::vector<double> at_rest() const;  ///< an open hand, kArmAtRest; rad
  std::vector<JointMotion> motions(const CommandLimits& limits) const;
};

/// Where a server begins, and who says so.
struct StartPlace {
  std::vector<double> joints;  ///< rad, in the order of ServedRobot::names
  std::string source = "start";
  double tolerance = radians_from_degrees(1e-6);  ///< rad: twice what an angle of a log may be off
};

/// Serves hand, arm or both, without a middleware and without a clock.
///
/// A target that is not followed any more (CommandStream::is_current) moves nothing; each topic counts by itself.
/// J1 and J2 of a finger are taken as their motor's J0 = J1 + J2 and split by the limits' coupling. With hand and
/// arm, fingertips are limited in the arm's base frame. Without an arm the speed of fingertips is limited in the
/// frame of the forearm. Without the hand the wrist stays kShadowWristReach inside the workspace on all sides, and
/// moves and turns only as fast as every point within that reach may, as a fingertip.
class RobotServer {
 public:
  /// Throws Error unless the start is a place that the robot could have gone to, or if the limits have problems.
  /// What misses a limit by no more than the start's tolerance is moved onto it.
  RobotServer(const CommandLimits& limits, const ServedRobot& robot, const StartPlace& start);

  /// Topics of joints that the server has.
  Receipt receive(RobotTopic topic, const ros::JointTrajectory& message, const Arrival& arrival);
  Receipt receive(RobotTopic topic, const ros::PoseStamped& message, const Arrival& arrival);
  /// What the joints shall do now. Later than the last tick. `may_move`: false holds them.
  RobotState tick(const ServerTime& now, bool may_move = true);
  /// rad, in the order of ServedRobot::names.
  const std::vector<double>& positions() const { return last_.position; }

  CommandStream& stream() { return stream_; }
  const CommandStream& stream() const { return stream_; }
  const Interventions& interventions() const { return guard_.interventions(); }

 private:
  Receipt judge(RobotTopic topic, const ros::Time& stamp, Receipt found, const Arrival& arrival);
  bool drop_old_goals(int64_t now_us);
  RobotTargets goal() const;
  RobotCommand limited(int64_t now_us, bool follows);
  std::vector<double> joints_of(const RobotTargets& targets) const;

  ServedRobot robot_;
  CommandGuard guard_;
  CommandStream stream_;
  RobotTargets stands_;  ///< where the joints were sent last
  std::array<double, kShadowJointCount> hand_goal_{};
  Eigen::Isometry3d T_base_wrist_goal_ = Eigen::Isometry3d::Identity();  ///< while the pose is wanted
  std::array<bool, kRobotTopicCount> wanted_{};                          ///< of each topic: there is a goal
  bool changed_ = false;                                                 ///< the goal, since the guard got it
  bool ticked_ = false;
  RobotState last_;
};

}  // namespace glovebench
