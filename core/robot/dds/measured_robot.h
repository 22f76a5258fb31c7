#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/robot/dds/dds_access.h"
#include "core/robot/robot_command.h"

namespace glovebench {

/// Where a robot stands.
struct MeasuredState {
  std::vector<double> hand;      ///< 24 joints in the order of ShadowJoint, rad
  std::optional<ArmJoints> arm;  ///< rad
};

/// Measured joints of hand and arm over DDS (`MeasuredJoints`): on `/glovebench/measured_joint_states`, or on the
/// controller's own `/joint_states` where the former has nothing to believe.
class MeasuredRobot {
 public:
  /// Throws Error if DDS does.
  MeasuredRobot(int domain, const DdsAccess& access, bool with_arm);
  ~MeasuredRobot();
  MeasuredRobot(const MeasuredRobot&) = delete;
  MeasuredRobot& operator=(const MeasuredRobot&) = delete;

  /// At most 0.1 s old. Waits up to `timeout_s` for it; then throws Error that says which topic lacks which joints.
  MeasuredState state(double timeout_s);

 private:
  class Readers;
  std::unique_ptr<Readers> readers_;
};

/// A measured joint may be that far beyond a limit and is taken to stand at it; so may J1 be beyond J2.
inline constexpr double kMeasuredNoise = 0.0175;  // rad, 1 degree

/// The targets at which the robot already is, for `CommandGuard::start_from`. Without an arm, T_base_hand is
/// `T_base_hand`. Throws Error if a joint is farther beyond its limits than kMeasuredNoise.
RobotTargets targets_at(const MeasuredState& state, const Eigen::Isometry3d& T_flange_wrist,
                        const Eigen::Isometry3d& T_base_hand);

}  // namespace glovebench
