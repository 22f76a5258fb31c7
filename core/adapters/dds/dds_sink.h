#pragma once

#include <cstdint>
#include <optional>

#include "core/adapters/dds/dds_entity.h"
#include "core/robot/command_guard.h"

namespace glovebench {

/// To whom a DdsSink speaks.
struct DdsSinkOptions {
  DdsAccess access;
  Topics topics = topics::kOwn;
  bool arm = true;                                         ///< false: the arm's topic is not spoken to
  double longest_step_s = CommandLimits().longest_step_s;  ///< of the guard of the commands
  bool alone = false;                                      ///< nobody else may write on the topics
};

/// Sends commands over DDS as a node of ROS 2 would (core/adapters/dds/README.md has topics and types): the joints
/// of the hand, those of its wrist, and a pose for the arm, one message of each a command. Nothing is sent while a
/// command holds or has no targets yet. Nobody has to listen, and nobody who does holds it up.
class DdsSink : public RobotCommandSink {
 public:
  /// Domain 0..230. Throws Error if there is no such domain or no network, or, if the sink must be alone, as soon
  /// as there is another writer; for that it looks for a second before it writes.
  explicit DdsSink(int domain = 0, const DdsSinkOptions& options = {});

  /// When the frame of the next command was there, microseconds since 1970: its messages carry it as their source
  /// time. Without a call: the moment when it is sent.
  void frame_arrived(int64_t system_us) { arrived_ns_ = system_us * 1000; }
  /// Throws Error if a target is not finite, a time stamp is negative, DDS refuses, or there is another writer and
  /// the sink must be alone.
  void send(const RobotCommand& command) override;
  /// Waits until those who listen have everything, at most a second.
  void finish() override;

  int64_t sent() const { return sent_; }  ///< commands
  int listeners() const;                  ///< now, to the topic that has the fewest

 private:
  DdsParticipant participant_;
  std::optional<DdsOtherWriters> others_;  ///< before the writers: one that runs does not see who only looks
  DdsWriter<ros::JointTrajectory> hand_, wrist_;
  std::optional<DdsWriter<ros::PoseStamped>> arm_;
  std::optional<int64_t> arrived_ns_;
  int64_t time_to_targets_us_, sent_ = 0;
};

}  // namespace glovebench
