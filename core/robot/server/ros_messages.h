#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// The messages of ROS that hand and arm speak, as plain structs: what any middleware brings, unchecked.
namespace glovebench::ros {

/// builtin_interfaces/Time and Duration
struct Time {
  int32_t sec = 0;
  uint32_t nanosec = 0;
};

/// trajectory_msgs/JointTrajectoryPoint. Velocities, accelerations and efforts are neither sent nor heeded.
struct JointTrajectoryPoint {
  std::vector<double> positions;  ///< rad
  Time time_from_start;
};

/// trajectory_msgs/JointTrajectory
struct JointTrajectory {
  Time stamp;
  std::string frame_id;
  std::vector<std::string> joint_names;
  std::vector<JointTrajectoryPoint> points;
};

/// geometry_msgs/PoseStamped
struct PoseStamped {
  Time stamp;
  std::string frame_id;
  double x = 0, y = 0, z = 0;  ///< m
  double qx = 0, qy = 0, qz = 0, qw = 1;
};

/// sensor_msgs/JointState. Efforts are not known and left out.
struct JointState {
  Time stamp;
  std::vector<std::string> name;
  std::vector<double> position;  ///< rad
  std::vector<double> velocity;  ///< rad/s
};

}  // namespace glovebench::ros
