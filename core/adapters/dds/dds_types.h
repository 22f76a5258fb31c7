#pragma once

#include <dds/dds.h>

#include <cstdint>

#include "core/adapters/dds/command_messages.h"

namespace glovebench {

/// The Cyclone DDS type of a ROS message. `write` returns Cyclone's code.
template <typename Message>
struct DdsType;

template <>
struct DdsType<ros::JointTrajectory> {
  static const dds_topic_descriptor_t& descriptor();
  static dds_return_t write(dds_entity_t writer, const ros::JointTrajectory& message, int64_t source_ns);
  static ros::JointTrajectory read(const void* sample);
};

template <>
struct DdsType<ros::PoseStamped> {
  static const dds_topic_descriptor_t& descriptor();
  static dds_return_t write(dds_entity_t writer, const ros::PoseStamped& message, int64_t source_ns);
  static ros::PoseStamped read(const void* sample);
};

template <>
struct DdsType<ros::JointState> {
  static const dds_topic_descriptor_t& descriptor();
  static dds_return_t write(dds_entity_t writer, const ros::JointState& message, int64_t source_ns);
  static ros::JointState read(const void* sample);
};

}  // namespace glovebench
