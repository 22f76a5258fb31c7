#pragma once

#include <cstdint>
#include <optional>

#include "core/adapters/dds/dds_entity.h"
#include "core/robot/command_guard.h"

namespace glovebench {

struct DdsSinkOptions {
  DdsAccess access;
  Topics topics = topics::kOwn;
  bool arm = true;
  double longest_step_s = CommandLimits().longest_step_s;  ///< of the commands' guard
  bool alone = false;                                      ///< allow no other writer
};

/// Sends commands as a ROS 2 node (core/adapters/dds/README.md). Does not wait for listeners.
class DdsSink : public RobotCommandSink {
 public:
  /// `domain`: 0..230.
  /// Throws: Error if domain or network is unusable or, if `alone`, another writer appears within 1 s.
  explicit DdsSink(int domain = 0, const DdsSinkOptions& options = {});

  /// Sets the next command's source time, us since 1970 (default: time of sending).
  void frame_arrived(int64_t system_us) { arrived_ns_ = system_us * 1000; }
  /// Throws: Error if a target is not finite, a time stamp is negative, DDS refuses, or another writer breaks
  /// `alone`.
  void send(const RobotCommand& command) override;
  /// Waits up to 1 s for listeners to have all messages.
  void finish() override;

  int64_t sent() const { return sent_; }
  int listeners() const;  ///< minimum over the topics

 private:
  DdsParticipant participant_;
  std::optional<DdsOtherWriters> others_;  ///< before the writers: searches before this writes
  DdsWriter<ros::JointTrajectory> hand_, wrist_;
  std::optional<DdsWriter<ros::PoseStamped>> arm_;
  std::optional<int64_t> arrived_ns_;
  int64_t time_to_targets_us_, sent_ = 0;
};

}  // namespace glovebench
