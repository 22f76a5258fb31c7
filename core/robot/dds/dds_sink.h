#pragma once

#include <cstdint>
#include <optional>

#include "core/robot/dds/dds_entity.h"
#include "core/robot/robot_command.h"

namespace glovebench {

/// To whom a DdsSink speaks.
struct DdsSinkOptions {
  DdsAccess access;
  Topics topics = topics::kOwn;
  bool arm = true;  ///< false: the arm's topic is not spoken to
};

/// Sends commands over DDS as a node of ROS 2 would (core/robot/README.md: topics, types, quality of service): the
/// joints of the hand, those of its wrist, and a pose for the arm, one message of each a command. A lost frame
/// sends the last targets again; before the first tracked frame nothing is sent. Nobody has to listen, and nobody
/// who does holds it up.
class DdsSink : public RobotCommandSink {
 public:
  /// Domain 0..230. Throws Error if there is no such domain or no network.
  explicit DdsSink(int domain = 0, const DdsSinkOptions& options = {});

  /// When the frame of the next command was there, microseconds since 1970: its messages carry it as their source
  /// time. Without a call: the moment when it is sent.
  void frame_arrived(int64_t system_us) { arrived_ns_ = system_us * 1000; }
  /// Throws Error if a target is not finite, a time stamp is negative, or DDS refuses.
  void send(const RobotCommand& command) override;
  /// Waits until those who listen have everything, at most a second.
  void finish() override;

  int64_t sent() const { return sent_; }  ///< commands
  int listeners() const;                  ///< now, to the topic that has the fewest

 private:
  int64_t next_period(int64_t command_us);

  DdsParticipant participant_;
  DdsWriter<ros::JointTrajectory> hand_, wrist_;
  std::optional<DdsWriter<ros::PoseStamped>> arm_;
  std::optional<int64_t> arrived_ns_, command_us_;
  int64_t period_us_, sent_ = 0;
};

}  // namespace glovebench
