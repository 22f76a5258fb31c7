#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/robot/dds/dds_entity.h"
#include "core/robot/server/ros_messages.h"

namespace glovebench {

/// Older than this, a state is not believed; nor is one that is farther ahead in time.
inline constexpr int64_t kMeasuredAgeUs = 100'000;

/// Where a robot's joints are, as its driver tells other processes: sensor_msgs/JointState on a topic.
///
/// A message is believed if it has each of the joints once, with a finite position; joints of other names do not
/// matter. Its age is the longest of three: since DDS's source time and since its header's stamp (unless that is
/// 0), both by this host's system clock, and since it was taken from DDS. Hosts whose clocks differ by more than
/// 0.1 s therefore do not believe each other. While two processes tell of the joints, neither is believed.
class MeasuredJoints {
 public:
  /// `names`: the joints, in the order of the answers.
  MeasuredJoints(const DdsParticipant& participant, const std::string& topic, std::vector<std::string> names);

  /// Positions (rad) by the newest message. Nothing unless that message is believed and at most 0.1 s old.
  /// `system_us`: now, since 1970. `steady_us`: now, by a clock that does not go back.
  std::optional<std::vector<double>> latest(int64_t system_us, int64_t steady_us);
  /// Why the last call of `latest` had no answer; empty if it had one.
  const std::string& doubt() const { return doubt_; }
  const std::string& topic() const { return topic_; }
  const std::vector<std::string>& names() const { return names_; }

 private:
  struct State {
    std::vector<double> positions;  ///< empty if `fault` is not
    std::string fault;
    int64_t source_us = 0;
    std::optional<int64_t> stamp_us;
    int64_t taken_us = 0;  ///< steady clock
  };
  void take_all(int64_t steady_us);
  State read(const ros::JointState& message) const;
  std::string find_doubt(int64_t system_us, int64_t steady_us) const;

  std::string topic_;
  std::vector<std::string> names_;
  DdsReader<ros::JointState> reader_;
  std::optional<State> state_;           ///< of the newest message that names one of the joints
  std::map<uint64_t, int64_t> tellers_;  ///< processes that told of the joints lately, and when (steady clock)
  std::string doubt_ = "nothing asked";
};

}  // namespace glovebench
