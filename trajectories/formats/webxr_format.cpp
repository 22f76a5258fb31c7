#include <fmt/format.h>

#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "core/base/text.h"
#include "trajectories/capture/marker_places.h"
#include "trajectories/formats/format.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {
namespace {

constexpr const char* kWebxrFormat = "glovebench-webxr-joints";
constexpr int kWebxrVersion = 1;

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

/// Joint positions as a page records them from XRFrame.getJointPose (README.md). Joints that a frame does not name
/// are gaps.
MarkerSequence parse_webxr(std::string_view text, Side, const std::string& where) {
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

}  // namespace

Format webxr_format() {
  return {.name = "webxr",
          .ending = ".json",
          .description = "joint positions that a page recorded from WebXR (README.md)",
          .markers = parse_webxr};
}

}  // namespace glovebench::trajectories
