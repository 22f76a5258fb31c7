#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/image.h"
#include "core/camera/rgbd_calibration.h"

namespace glovebench::eval {

// Messages of ROS, little-endian. Every function throws Error for damaged ones.

enum class RosEncoding { cdr, ros1 };
struct RosMessage {
  std::string_view bytes;
  RosEncoding encoding = RosEncoding::cdr;  ///< of ROS 2, of ROS 1
};

struct RosHead {
  int64_t timestamp_us = 0;
  std::string frame;
};

/// sensor_msgs/Image.
struct RosImage {
  RosHead head;
  int width = 0, height = 0;  ///< within the limits of images
  std::string encoding;
  size_t step = 0;         ///< bytes of a row
  std::string_view bytes;  ///< of all rows; part of the message
};
RosImage parse_ros_image(const RosMessage& message, const std::string& where);
/// From rgb8 or bgr8.
ColorImage color_of(const RosImage& image, const std::string& where);
/// From 16UC1, mono16 (mm) or 32FC1 (m). m; 0: no value.
DepthImage depth_of(const RosImage& image, const std::string& where);

/// sensor_msgs/CameraInfo.
struct RosCamera {
  PinholeCamera camera, rectified;  ///< of raw and of rectified images
  LensDistortion lens;              ///< of raw images
};
RosCamera parse_ros_camera(const RosMessage& message, const std::string& where);

struct RosTransform {
  std::string parent, child;
  Eigen::Isometry3d T_parent_child;
};
/// tf2_msgs/TFMessage.
std::vector<RosTransform> parse_ros_transforms(const RosMessage& message, const std::string& where);

}  // namespace glovebench::eval
