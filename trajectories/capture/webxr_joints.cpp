#include "trajectories/capture/webxr_joints.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "core/base/error.h"
#include "core/base/excerpt.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "core/hand/skeleton.h"
#include "trajectories/capture/marker_cells.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {
namespace {

constexpr const char* kWebxrFormat = "glovebench-webxr-joints";
constexpr int kWebxrVersion = 1;
constexpr int kWebxrJointCount = kForearmJoint;  ///< the forearm is ours

MarkerSequence sequence_of_joints() {
  MarkerSequence sequence;
  for (int j = 0; j < kWebxrJointCount; ++j) sequence.names.push_back(joint_name(j));
  return sequence;
}

MarkerFrame webxr_frame(const JsonCursor& field) {
  field.expect_keys({"timestamp_us", "joints_m"});
  MarkerFrame frame;
  frame.timestamp_us = field["timestamp_us"].integer(0, kMaxTimestampUs);
  frame.points.assign(kWebxrJointCount, gap());
  for (const auto& [name, position] : field["joints_m"].members()) {
    if (!is_webxr_joint(name)) position.fail(quoted_excerpt(name), "the name of a WebXR hand joint");
    frame.points[static_cast<size_t>(joint_index(name))] = position.vector3(kMaxCoordinate);
  }
  return frame;
}

/// The float at that place.
double float_at(std::string_view bytes, size_t index, const std::string& where) {
  uint32_t bits = 0;
  for (size_t b = 0; b < 4; ++b) {
    bits |= static_cast<uint32_t>(static_cast<uint8_t>(bytes[4 * index + b])) << (8 * b);
  }
  const auto value = static_cast<double>(std::bit_cast<float>(bits));
  if (!(std::abs(value) <= kMaxCoordinate)) {
    throw Error(where, fmt::format("float {}", index), fmt::format("{}", value),
                fmt::format("a number from {} to {}", -kMaxCoordinate, kMaxCoordinate));
  }
  return value;
}

}  // namespace

bool is_webxr_joint(const std::string& name) {
  for (int j = 0; j < kWebxrJointCount; ++j) {
    if (joint_name(j) == name) return true;
  }
  return false;
}

MarkerSequence parse_webxr_joints(std::string_view text, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  const JsonCursor root(document, where);
  root.expect_keys({"format", "version", "frames"});
  root.expect_format(kWebxrFormat, kWebxrVersion);
  MarkerSequence sequence = sequence_of_joints();
  const JsonItems frames = root["frames"].some_items();
  int64_t first_us = 0;
  for (size_t i = 0; i < frames.size(); ++i) {
    MarkerFrame frame = webxr_frame(frames[i]);
    if (i == 0) first_us = frame.timestamp_us;
    add_frame(std::move(frame), first_us, text.size(), sequence, where, fmt::format("frames[{}].timestamp_us", i));
  }
  return sequence;
}

MarkerSequence parse_handpose(std::string_view bytes, Side side, const std::string& where) {
  constexpr size_t joints = kWebxrJointCount, floats = 1 + 2 * 16 * joints + 2 * joints;
  if (bytes.size() != 4 * floats) {
    throw Error(where, "size", fmt::format("{} bytes", bytes.size()), fmt::format("{}", 4 * floats));
  }
  const double count = float_at(bytes, 0, where);
  if (count != static_cast<double>(joints)) {
    throw Error(where, "float 0", fmt::format("{}", count), fmt::format("{}, the number of joints", joints));
  }
  MarkerSequence sequence = sequence_of_joints();
  MarkerFrame frame;
  for (size_t j = 0; j < joints; ++j) {
    const size_t matrix = 1 + 16 * (j + (side == Side::right ? joints : 0));
    constexpr size_t translation = 12;
    Eigen::Vector3d p;
    for (size_t i = 0; i < 3; ++i) p[static_cast<int>(i)] = float_at(bytes, matrix + translation + i, where);
    frame.points.push_back(p);
  }
  sequence.frames.push_back(std::move(frame));
  return sequence;
}

}  // namespace glovebench::trajectories
