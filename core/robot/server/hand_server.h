#pragma once

#include <array>

#include "core/robot/command_guard.h"
#include "core/robot/server/command_messages.h"
#include "core/robot/server/command_stream.h"
#include "core/robot/server/robot_state.h"
#include "core/robot/server/start_place.h"
#include "core/robot/server/stated_interval.h"

namespace glovebench {

/// Topics of the hand.
enum class HandTopic { fingers, wrist };

/// The hand's side of the stream: messages in, states out, without a middleware and without a clock. What is wrong
/// in a message is counted, and it is as if it had not come. Those that CommandStream accepts set the target of
/// their joints; a tick moves towards it no farther than CommandGuard allows. A target that is not followed any
/// more (CommandStream::is_current) moves nothing. Of several messages between two ticks the last one counts. J1
/// and J2 of a finger are taken as their motor's J0 = J1 + J2 and split by the limits' coupling. The speed of
/// fingertips is limited in the frame of the forearm: where the arm takes it is not known here.
class HandServer {
 public:
  /// `start`: where the joints stand, in the order of ShadowJoint. Throws Error unless they are within the limits
  /// (start_place.h), or if the limits have problems.
  HandServer(const CommandLimits& limits, const StartPlace& start);
  /// What the joints can do under these limits.
  static std::vector<JointMotion> joint_motions(const CommandLimits& limits);

  Receipt receive(HandTopic topic, const ros::JointTrajectory& message, const Arrival& arrival);
  /// What the joints shall do now. Later than the last tick. `may_move`: false holds them.
  RobotState tick(const ServerTime& now, bool may_move = true);
  /// rad, in the order of ShadowJoint.
  const std::vector<double>& positions() const { return last_.position; }

  CommandStream& stream() { return stream_; }
  const CommandStream& stream() const { return stream_; }
  const Interventions& interventions() const { return guard_.interventions(); }

 private:
  bool drop_old_goals(int64_t now_us);

  CommandGuard guard_;
  CommandStream stream_;
  RobotTargets goal_;
  std::array<bool, 2> wanted_{};  ///< of each topic: its joints have a goal
  bool changed_ = false;          ///< the goal, since the guard got it
  bool ticked_ = false;
  RobotState last_;
};

}  // namespace glovebench
