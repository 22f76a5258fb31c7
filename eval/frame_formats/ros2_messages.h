#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/base/image.h"
#include "core/camera/pinhole_camera.h"
#include "core/hand/posture.h"

namespace glovebench::eval {

// Messages of ROS 2 (Humble) as CDR, little-endian.

struct RosHeader {
  int64_t timestamp_us = 0;
  std::string_view frame;
};

/// sensor_msgs/Image, "rgb8".
std::string ros_image(const RosHeader& header, const ColorImage& image);
/// sensor_msgs/Image, "16UC1", mm; 0: no value.
std::string ros_depth_image(const RosHeader& header, const DepthImage& depth);
/// sensor_msgs/CameraInfo, without distortion.
std::string ros_camera_info(const RosHeader& header, const PinholeCamera& camera);
/// geometry_msgs/PoseStamped.
std::string ros_pose(const RosHeader& header, const Eigen::Isometry3d& T_frame_object);
/// sensor_msgs/JointState: 22 angles, rad.
std::string ros_joint_state(const RosHeader& header, const Posture& posture);
/// tf2_msgs/TFMessage.
std::string ros_transform(const RosHeader& header, std::string_view child, const Eigen::Isometry3d& T_frame_child);

using RosColor = std::array<float, 4>;  ///< red, green, blue, opacity; 0..1
struct RosLine {
  Eigen::Vector3d from, to;
};
/// visualization_msgs/MarkerArray: spheres and lines. Without spheres it deletes both.
std::string ros_markers(const RosHeader& header, std::string_view name, std::span<const Eigen::Vector3d> spheres,
                        std::span<const RosLine> lines, const RosColor& color);

/// Definition of a type ("sensor_msgs/Image") and of all that it names, as MCAP's "ros2msg".
std::string ros_definition(std::string_view type);

}  // namespace glovebench::eval
