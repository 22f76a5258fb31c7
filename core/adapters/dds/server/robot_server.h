#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/adapters/dds/command_messages.h"
#include "core/adapters/dds/server/command_stream.h"
#include "core/adapters/dds/server/stated_interval.h"
#include "core/base/math.h"
#include "core/robot/command_guard.h"

namespace glovebench {

// RobotServer::receive checks a message with read_joints or read_pose, then with CommandStream. An `accepted`
// message is its topic's goal until the next one. A tick moves towards the goals as far as CommandGuard and
// MotionLog allow.

/// `pose`: of the wrist.
enum class RobotTopic { fingers, wrist, pose };
inline constexpr int kRobotTopicCount = 3;
std::string_view to_string(RobotTopic topic);

struct ServedRobot {
  bool hand = true;
  std::optional<MountedArm> arm = std::nullopt;

  GuardedPart part() const;
  std::string name() const;  ///< "hand", "arm" or "hand and arm"
  /// The hand's joints (ShadowJoint), then the arm's.
  std::vector<std::string> names() const;
  std::vector<double> at_rest() const;  ///< rad: open hand, kArmAtRest
  std::vector<JointMotion> motions(const CommandLimits& limits) const;
};

struct StartPlace {
  std::vector<double> joints;  ///< rad
  std::string source = "start";
  double tolerance = radians_from_degrees(1e-6);  ///< rad: twice the log's rounding
};

/// Serves hand, arm or both. Knows no middleware or clock. A topic without a current message (CommandStream) moves
/// nothing. The coupling splits the sum of J1 and J2.
class RobotServer {
 public:
  /// Moves joints onto a limit that they exceed by at most the start's tolerance.
  /// Throws: Error if the start is farther outside, or the limits have problems.
  RobotServer(const CommandLimits& limits, const ServedRobot& robot, const StartPlace& start);

  Receipt receive(RobotTopic topic, const ros::JointTrajectory& message, const Arrival& arrival);
  Receipt receive(RobotTopic topic, const ros::PoseStamped& message, const Arrival& arrival);
  /// Time must have advanced. Without `may_move` the joints hold.
  RobotState tick(const ServerTime& now, bool may_move = true);
  /// Units: rad.
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
  RobotTargets stands_;
  std::array<double, kShadowJointCount> hand_goal_{};
  Eigen::Isometry3d T_base_wrist_goal_ = Eigen::Isometry3d::Identity();
  std::array<bool, kRobotTopicCount> wanted_{};
  bool changed_ = false;
  bool ticked_ = false;
  RobotState last_;
};

}  // namespace glovebench
