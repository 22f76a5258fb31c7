#pragma once

#include "core/adapters/dds/server/command_messages.h"
#include "core/base/math.h"

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

}  // namespace glovebench
