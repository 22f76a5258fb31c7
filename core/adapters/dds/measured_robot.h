#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/adapters/dds/dds_entity.h"
#include "core/adapters/dds/server/command_messages.h"

namespace glovebench {

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

/// Where a robot stands.
struct MeasuredState {
  std::vector<double> hand;      ///< 24 joints in the order of ShadowJoint, rad; empty if they are not asked for
  std::optional<ArmJoints> arm;  ///< rad; empty alike
};

/// Measured joints of hand and arm, each by the first of some topics that has something to believe.
class MeasuredRobot {
 public:
  MeasuredRobot(const DdsParticipant& participant, const std::vector<std::string>& topics, bool hand, bool arm);

  /// Now. Nothing if a joint is not known.
  std::optional<MeasuredState> look();
  /// Waits up to `timeout_s` for it; then throws Error that says which topic lacks which joints.
  MeasuredState state(double timeout_s);

 private:
  [[noreturn]] void refuse() const;

  dds_domainid_t domain_ = 0;
  std::vector<MeasuredJoints> hand_, arm_;  ///< the one to prefer first; empty if it is not asked for
};

/// A measured joint may be that far beyond a limit and is taken to stand at it; so may J1 be beyond J2.
inline constexpr double kMeasuredNoise = 0.0175;  // rad, 1 degree

/// The targets at which the robot already is, for `CommandGuard::start_from`. Without an arm, T_base_hand is
/// `T_base_hand`. Throws Error if a joint is farther beyond its limits than kMeasuredNoise.
RobotTargets targets_at(const MeasuredState& state, const Eigen::Isometry3d& T_flange_wrist,
                        const Eigen::Isometry3d& T_base_hand);

}  // namespace glovebench
