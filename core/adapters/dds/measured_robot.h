#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/adapters/dds/command_messages.h"
#include "core/adapters/dds/dds_entity.h"

namespace glovebench {

/// Joints measured by the robot's driver (core/adapters/dds/README.md, "A controller's topics").
class MeasuredJoints {
 public:
  /// `names`: order of results.
  MeasuredJoints(const DdsParticipant& participant, const std::string& topic, std::vector<std::string> names);

  /// The newest message's positions, rad, if trusted. `system_us`: since 1970. `steady_us`: monotonic.
  std::optional<std::vector<double>> latest(int64_t system_us, int64_t steady_us);
  /// Why `latest` returned nothing, else "".
  const std::string& doubt() const { return doubt_; }
  const std::string& topic() const { return topic_; }

 private:
  struct State {
    std::vector<double> positions;
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
  std::optional<State> state_;
  std::map<uint64_t, int64_t> tellers_;  ///< by publisher: last message, steady clock
  std::string doubt_ = "nothing asked";
};

struct MeasuredState {
  std::vector<double> hand;      ///< rad, by ShadowJoint; empty if not requested
  std::optional<ArmJoints> arm;  ///< likewise
};

/// Each joint comes from the first trusted topic.
class MeasuredRobot {
 public:
  MeasuredRobot(const DdsParticipant& participant, const std::vector<std::string>& topics, bool hand, bool arm);

  /// Empty if any joint is unknown.
  std::optional<MeasuredState> look();
  /// Throws: Error unless all joints are known within `timeout_s`.
  MeasuredState state(double timeout_s);

 private:
  [[noreturn]] void refuse() const;

  dds_domainid_t domain_ = 0;
  std::vector<MeasuredJoints> hand_, arm_;  ///< by preference
};

/// A joint this far beyond a limit, or J1 beyond J2, counts as at the limit.
inline constexpr double kMeasuredNoise = 0.0175;  // rad, 1 degree

/// Targets for `CommandGuard::start_from`. `T_base_hand` is used only without an arm.
/// Throws: Error if a joint exceeds a limit by more than kMeasuredNoise.
RobotTargets targets_at(const MeasuredState& state, const Eigen::Isometry3d& T_flange_wrist,
                        const Eigen::Isometry3d& T_base_hand);

}  // namespace glovebench
