#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "core/base/text.h"
#include "core/base/whole_file.h"
#include "trajectories/formats/format.h"
#include "trajectories/posture_file.h"
#include "trajectories/text_cells.h"

namespace glovebench::trajectories {
namespace {

constexpr const char* kTrajectoryFormat = "glovebench-trajectory";
constexpr int kTrajectoryVersion = 1;
constexpr double kQuaternionStep = 1e-7;

Eigen::Quaterniond quaternion_from(const JsonCursor& field) {
  const JsonItems items = field.items(4);
  std::array<double, 4> wxyz;
  for (size_t i = 0; i < 4; ++i) wxyz[i] = items[i].number(-2, 2);
  const Eigen::Quaterniond quaternion(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  if (std::abs(quaternion.norm() - 1) > kQuaternionNormTolerance) {
    field.fail(fmt::format("length {:.6f}", quaternion.norm()),
               fmt::format("length 1 within {}", kQuaternionNormTolerance));
  }
  return quaternion.normalized();
}

/// The quaternion (w, x, y, z) on the grid of the file. Rounding takes it off the unit sphere, so that reading
/// and rounding again may give a neighbor; each such step brings it nearer to the sphere, so it comes to rest.
Eigen::Vector4d canonical_wxyz(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond quaternion(rotation);
  Eigen::Vector4d rounded(quaternion.w(), quaternion.x(), quaternion.y(), quaternion.z());
  if (!rounded.allFinite()) return rounded;  // refused when the text is checked
  for (Eigen::Vector4d previous = Eigen::Vector4d::Zero(); rounded != previous;) {
    previous = rounded;
    rounded = (rounded.normalized() / kQuaternionStep).array().round() * kQuaternionStep;
  }
  // q and -q are one rotation: the first component that is not zero is positive.
  for (int i = 0; i < 4; ++i)
    if (rounded[i] != 0) return rounded[i] > 0 ? rounded : Eigen::Vector4d(-rounded);
  return rounded;
}

HandFrame frame_from(const JsonCursor& field) {
  HandFrame frame;
  frame.timestamp_us = field["timestamp_us"].integer(0, kMaxTimestampUs);
  frame.posture = angles_from(field["angles_deg"]);
  frame.T_camera_hand.translation() = field["position_mm"].vector3(kMaxPositionMm) / 1000;
  frame.T_camera_hand.linear() = quaternion_from(field["quaternion_wxyz"]).toRotationMatrix();
  return frame;
}

std::vector<HandFrame> frames_from(const JsonCursor& field) {
  std::vector<HandFrame> frames;
  const JsonItems items = field.some_items();
  // Room is made for all only when each is known to be a frame.
  for (const JsonCursor& item : items)
    item.expect_keys({"timestamp_us", "angles_deg", "position_mm", "quaternion_wxyz"});
  frames.reserve(items.size());
  for (const JsonCursor& item : items) {
    const HandFrame frame = frame_from(item);
    if (!frames.empty() && frame.timestamp_us <= frames.back().timestamp_us)
      item["timestamp_us"].fail(fmt::format("more than {}", frames.back().timestamp_us));
    frames.push_back(frame);
  }
  return frames;
}

Provenance provenance_from(const JsonCursor& field) {
  field.expect_keys({"source", "source_hash", "database", "database_hash", "profile", "profile_hash"});
  return {.source = field["source"].name(),
          .source_hash = field["source_hash"].name(),
          .database = field["database"].name(),
          .database_hash = field["database_hash"].name(),
          .profile = field["profile"].name(),
          .profile_hash = field["profile_hash"].name()};
}

std::string provenance_json(const Provenance& provenance) {
  return fmt::format(R"({{
    "source": {}, "source_hash": {},
    "database": {}, "database_hash": {},
    "profile": {}, "profile_hash": {}
  }})",
                     in_quotes(provenance.source), in_quotes(provenance.source_hash),
                     in_quotes(provenance.database), in_quotes(provenance.database_hash),
                     in_quotes(provenance.profile), in_quotes(provenance.profile_hash));
}

std::string frame_json(const HandFrame& frame) {
  const Eigen::Vector3d position_mm = frame.T_camera_hand.translation() * 1000;
  const Eigen::Vector4d wxyz = canonical_wxyz(frame.T_camera_hand.linear());
  return fmt::format(
      "    {{\"timestamp_us\": {}, \"position_mm\": [{}, {}, {}], "
      "\"quaternion_wxyz\": [{}, {}, {}, {}],\n     \"angles_deg\": {}}}",
      frame.timestamp_us, fixed(position_mm.x(), 3), fixed(position_mm.y(), 3), fixed(position_mm.z(), 3),
      fixed(wxyz[0], 7), fixed(wxyz[1], 7), fixed(wxyz[2], 7), fixed(wxyz[3], 7), angles_json(frame.posture));
}

std::string canonical_json(const Trajectory& trajectory) {
  std::string json = fmt::format("{{\n  \"format\": {},\n  \"version\": {},\n  \"name\": {},\n",
                                 in_quotes(kTrajectoryFormat), kTrajectoryVersion, in_quotes(trajectory.name));
  json +=
      fmt::format("  \"description\": {},\n  \"side\": {},\n  \"kind\": {},\n", in_quotes(trajectory.description),
                  in_quotes(to_string(trajectory.side)), in_quotes(to_string(trajectory.kind)));
  if (trajectory.provenance)
    json += fmt::format("  \"provenance\": {},\n", provenance_json(*trajectory.provenance));
  json += fmt::format("  \"joint_order\": {},\n  \"frames\": [\n", joint_order_json());
  for (size_t i = 0; i < trajectory.frames.size(); ++i)
    json += (i > 0 ? ",\n" : "") + frame_json(trajectory.frames[i]);
  return json + "\n  ]\n}\n";
}

}  // namespace

Trajectory parse_trajectory(std::string_view text, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  const JsonCursor root(document, where);
  root.expect_keys({"format", "version", "name", "side", "joint_order", "frames"},
                   {"description", "kind", "provenance"});
  root.expect_format(kTrajectoryFormat, kTrajectoryVersion);
  expect_joint_order(root["joint_order"]);

  Trajectory trajectory;
  trajectory.name = root["name"].name();
  if (root.has("description")) trajectory.description = root["description"].text();
  trajectory.side = root["side"].one_of<Side>();
  if (root.has("kind")) trajectory.kind = root["kind"].one_of<TrajectoryKind>();
  if (root.has("provenance")) trajectory.provenance = provenance_from(root["provenance"]);
  if (trajectory.provenance.has_value() != (trajectory.kind == TrajectoryKind::recorded)) {
    throw Error(where, "provenance", trajectory.provenance ? "one with kind \"source\"" : "none",
                "one if and only if kind is \"recorded\"");
  }
  trajectory.frames = frames_from(root["frames"]);
  return trajectory;
}

std::string canonical_text(const Trajectory& trajectory) {
  std::string json = canonical_json(trajectory);
  // Whatever is wrong with a trajectory made in memory is said where it is made, not by a later reader.
  parse_trajectory(json, "trajectory " + quoted_excerpt(trajectory.name));
  return json;
}

void write_trajectory(const Trajectory& trajectory, const std::string& path) {
  write_file(path, canonical_text(trajectory));
}

std::string hash(const Trajectory& trajectory) { return hash_text(canonical_text(trajectory)); }

Format trajectory_format() {
  return {.name = "trajectory",
          .ending = ".json",
          .description = "glovebench's own movements: posture and pose of every frame (README.md)",
          .trajectory = parse_trajectory};
}

}  // namespace glovebench::trajectories
