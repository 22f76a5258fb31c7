#include "core/adapters/dds/dds_types.h"

#include <adapters/dds/ros_messages.h>

#include <string>
#include <vector>

namespace glovebench {
namespace {

using CTrajectory = trajectory_msgs_msg_dds__JointTrajectory_;
using CPoint = trajectory_msgs_msg_dds__JointTrajectoryPoint_;
using CPose = geometry_msgs_msg_dds__PoseStamped_;
using CState = sensor_msgs_msg_dds__JointState_;
using CHeader = std_msgs_msg_dds__Header_;

// The library writes from C structs and changes nothing in them: they borrow what the messages own.

CHeader borrow_header(const ros::Time& stamp, const std::string& frame_id) {
  return {{stamp.sec, stamp.nanosec}, const_cast<char*>(frame_id.c_str())};
}

dds_sequence_double borrow(const std::vector<double>& values) {
  const auto size = static_cast<uint32_t>(values.size());
  return {size, size, const_cast<double*>(values.data()), false};
}

std::vector<char*> borrow_names(const std::vector<std::string>& names) {
  std::vector<char*> pointers;
  for (const std::string& name : names) pointers.push_back(const_cast<char*>(name.c_str()));
  return pointers;
}

dds_sequence_string borrow(std::vector<char*>& names) {
  const auto size = static_cast<uint32_t>(names.size());
  return {size, size, names.data(), false};
}

std::string text(const char* characters) { return characters ? characters : ""; }

std::vector<double> copied(const dds_sequence_double& values) {
  return {values._buffer, values._buffer + values._length};
}

std::vector<std::string> copied(const dds_sequence_string& names) {
  std::vector<std::string> copies;
  for (uint32_t i = 0; i < names._length; ++i) copies.push_back(text(names._buffer[i]));
  return copies;
}

ros::Time stamp_of(const CHeader& header) { return {header.stamp.sec, header.stamp.nanosec}; }

}  // namespace

const dds_topic_descriptor_t& DdsType<ros::JointTrajectory>::descriptor() {
  return trajectory_msgs_msg_dds__JointTrajectory__desc;
}

dds_return_t DdsType<ros::JointTrajectory>::write(dds_entity_t writer, const ros::JointTrajectory& message,
                                                  int64_t source_ns) {
  std::vector<char*> names = borrow_names(message.joint_names);
  std::vector<CPoint> points;
  for (const ros::JointTrajectoryPoint& point : message.points)
    points.push_back({.positions = borrow(point.positions),
                      .velocities = {},
                      .accelerations = {},
                      .effort = {},
                      .time_from_start = {point.time_from_start.sec, point.time_from_start.nanosec}});
  const auto size = static_cast<uint32_t>(points.size());
  const CTrajectory sample = {.header = borrow_header(message.stamp, message.frame_id),
                              .joint_names = borrow(names),
                              .points = {size, size, points.data(), false}};
  return dds_write_ts(writer, &sample, source_ns);
}

ros::JointTrajectory DdsType<ros::JointTrajectory>::read(const void* sample) {
  const auto& from = *static_cast<const CTrajectory*>(sample);
  ros::JointTrajectory message{stamp_of(from.header), text(from.header.frame_id), copied(from.joint_names), {}};
  for (uint32_t i = 0; i < from.points._length; ++i) {
    const CPoint& point = from.points._buffer[i];
    message.points.push_back({copied(point.positions), {point.time_from_start.sec, point.time_from_start.nanosec}});
  }
  return message;
}

const dds_topic_descriptor_t& DdsType<ros::PoseStamped>::descriptor() {
  return geometry_msgs_msg_dds__PoseStamped__desc;
}

dds_return_t DdsType<ros::PoseStamped>::write(dds_entity_t writer, const ros::PoseStamped& message,
                                              int64_t source_ns) {
  const CPose sample = {
      .header = borrow_header(message.stamp, message.frame_id),
      .pose = {{message.x, message.y, message.z}, {message.qx, message.qy, message.qz, message.qw}}};
  return dds_write_ts(writer, &sample, source_ns);
}

ros::PoseStamped DdsType<ros::PoseStamped>::read(const void* sample) {
  const auto& from = *static_cast<const CPose*>(sample);
  const auto& [p, q] = from.pose;
  return {stamp_of(from.header), text(from.header.frame_id), p.x, p.y, p.z, q.x, q.y, q.z, q.w};
}

const dds_topic_descriptor_t& DdsType<ros::JointState>::descriptor() {
  return sensor_msgs_msg_dds__JointState__desc;
}

dds_return_t DdsType<ros::JointState>::write(dds_entity_t writer, const ros::JointState& message,
                                             int64_t source_ns) {
  std::vector<char*> names = borrow_names(message.name);
  const std::string no_frame;
  const CState sample = {.header = borrow_header(message.stamp, no_frame),
                         .name = borrow(names),
                         .position = borrow(message.position),
                         .velocity = borrow(message.velocity),
                         .effort = {}};
  return dds_write_ts(writer, &sample, source_ns);
}

ros::JointState DdsType<ros::JointState>::read(const void* sample) {
  const auto& from = *static_cast<const CState*>(sample);
  return {stamp_of(from.header), copied(from.name), copied(from.position), copied(from.velocity)};
}

}  // namespace glovebench
