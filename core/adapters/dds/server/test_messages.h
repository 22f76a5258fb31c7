#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "core/adapters/dds/command_messages.h"
#include "core/base/math.h"
#include "core/robot/test_arm_solver.h"

namespace glovebench {

inline ros::Time test_stamp(int64_t time_us) {
  return {static_cast<int32_t>(time_us / 1'000'000), static_cast<uint32_t>(time_us % 1'000'000 * 1000)};
}

/// All joints at one angle.
inline ros::JointTrajectory trajectory_message(const std::vector<std::string>& names, double angle_deg,
                                               int64_t stamp_us) {
  ros::JointTrajectory message;
  message.stamp = test_stamp(stamp_us);
  message.joint_names = names;
  message.points.push_back({std::vector<double>(names.size(), radians_from_degrees(angle_deg)), {0, 33'000'000}});
  return message;
}

inline ros::PoseStamped pose_at(double x, double y, double z, int64_t stamp_us) {
  return {.stamp = test_stamp(stamp_us), .frame_id = kBaseFrame, .x = x, .y = y, .z = z};
}

inline constexpr int64_t kArmPeriodUs = 10'000;
inline constexpr uint64_t kSender = 3;
inline constexpr double kArmRounding = 1e-9;  // of a pose after seven rotations

/// For the arm's joints, which are the last.
inline Eigen::Isometry3d wrist_of(const std::vector<double>& positions, const Eigen::Isometry3d& T_flange_wrist) {
  ArmJoints joints;
  std::copy_n(positions.end() - kArmJointCount, kArmJointCount, joints.begin());
  return arm_flange_pose(joints) * T_flange_wrist;
}

/// Finds nothing while `asleep`.
class SleepingSolver : public JacobianSolver {
 public:
  std::optional<ArmJoints> solve(const Eigen::Isometry3d& T_base_flange, const ArmJoints& start) const override {
    return asleep ? std::nullopt : JacobianSolver::solve(T_base_flange, start);
  }
  bool asleep = true;
};

}  // namespace glovebench
