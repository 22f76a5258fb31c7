#pragma once

#include "core/robot/command_guard.h"
#include "core/robot/server/command_messages.h"
#include "core/robot/server/robot_state.h"
#include "core/robot/server/stream_gate.h"

namespace glovebench {

/// Topics of the hand.
enum class HandTopic { fingers, wrist };

/// The hand's side of the stream: messages in, states out, without a middleware and without a clock. What is wrong
/// in a message is counted, and it is as if it had not come. Good ones set the target; a tick moves towards it no
/// farther than CommandGuard allows, and holds and stops when messages fail to come. Of several between two ticks
/// the last one counts. J1 and J2 of a finger are taken as their motor's J0 = J1 + J2 and split by the limits'
/// coupling. The speed of fingertips is limited in the frame of the forearm: where the arm takes it is not known
/// here.
class HandServer {
 public:
  /// `start`: where the joints stand, rad, in the order of ShadowJoint; `source`: who says so. Throws Error unless
  /// they are within the limits (start_place.h), or if the limits have problems.
  HandServer(const CommandLimits& limits, const std::vector<double>& start,
             const std::string& source = "hand server");

  /// Whether a message of that sender is foreign, whatever is in it; then it is counted and need not be read.
  bool ignores(uint64_t sender, int64_t now_us);
  /// `now_us` is the server's own clock, as in `tick`. It must not go back.
  Receipt receive(uint64_t sender, HandTopic topic, const ros::JointTrajectory& message, int64_t now_us);
  /// What the joints shall do now. Later than the last tick.
  RobotState tick(int64_t now_us);

  StreamGate& gate() { return gate_; }
  const StreamGate& gate() const { return gate_; }
  const ReceiptCounts& receipts() const { return receipts_; }
  const Interventions& interventions() const { return guard_.interventions(); }

 private:
  CommandGuard guard_;
  StreamGate gate_;
  ReceiptCounts receipts_{};
  RobotTargets goal_;
  std::optional<uint64_t> sender_;  ///< of the last message that was accepted
  bool received_ = false;           ///< since the last tick
  bool ticked_ = false;
  RobotState last_;
};

}  // namespace glovebench
