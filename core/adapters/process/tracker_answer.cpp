#include "core/adapters/process/tracker_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/json_cursor.h"
#include "core/base/math.h"
#include "core/base/parse_json.h"

namespace glovebench {
namespace {

using nlohmann::ordered_json;

constexpr double kMostDegrees = 3600, kMost_mm = 1e6;

/// At zero angles, mm.
ordered_json joints_json(const HandModel& hand) {
  const JointPoses T_hand_joint = hand.skeleton().pose(Posture::Zero());
  const double x_sign = hand.side() == Side::left ? -1 : 1;
  ordered_json joints = ordered_json::array();
  for (int j = 0; j < kForearmJoint; ++j) {
    const Eigen::Vector3d p = 1000 * T_hand_joint[j].translation();
    const int parent = joint_parents()[j];
    joints.push_back({{"name", joint_name(j)},
                      {"parent", parent < 0 ? ordered_json() : ordered_json(joint_name(parent))},
                      {"position_mm", {x_sign * p.x(), p.y(), p.z()}}});
  }
  return joints;
}

Posture posture_from(const JsonCursor& angles_deg) {
  Posture posture;
  const JsonItems items = angles_deg.items(kAngleCount);
  for (int a = 0; a < kAngleCount; ++a)
    posture[a] = radians_from_degrees(items[a].number(-kMostDegrees, kMostDegrees));
  return posture;
}

Eigen::Quaterniond rotation_from(const JsonCursor& wxyz) {
  constexpr double kLargestError = 1e-3;
  const JsonItems items = wxyz.items(4);
  const Eigen::Quaterniond q(items[0].number(-2, 2), items[1].number(-2, 2), items[2].number(-2, 2),
                             items[3].number(-2, 2));
  if (std::abs(q.norm() - 1) > kLargestError)
    wxyz.fail(fmt::format("a norm of {:.3g}", q.norm()), "a unit quaternion w, x, y, z");
  return q.normalized();
}

RecycledVector<std::optional<Eigen::Vector3d>> joints_from(const JsonCursor& joints_mm) {
  RecycledVector<std::optional<Eigen::Vector3d>> joints;
  for (const JsonCursor& joint : joints_mm.items(kForearmJoint))
    joints.push_back(joint.is_null() ? std::nullopt
                                     : std::optional<Eigen::Vector3d>(joint.vector3(kMost_mm) / 1000));
  if (std::ranges::none_of(joints, [](const auto& joint) { return joint.has_value(); }))
    joints_mm.fail("only null", "a joint at least");
  return joints;
}

}  // namespace

std::string start_line(const RgbdCalibration& calibration, const HandModel& hand) {
  ordered_json angles = ordered_json::array();
  for (const AngleInfo& info : angle_infos())
    angles.push_back({{"name", info.name}, {"min_deg", info.min_deg}, {"max_deg", info.max_deg}});
  const ordered_json line = {{"protocol", "glovebench-tracker"},
                             {"version", kTrackerProtocol},
                             {"depth_unit_mm", kDepthUnit_mm},
                             {"calibration", to_json(calibration)},
                             {"hand", {{"side", to_string(hand.side())}, {"joints", joints_json(hand)}}},
                             {"angles", angles}};
  return line.dump() + "\n";
}

std::string frame_line(int number, const DeviceFrame& frame) {
  const ordered_json line = {{"frame", number},
                             {"depth_timestamp_us", frame.depth_timestamp_us},
                             {"color_timestamp_us", frame.color_timestamp_us},
                             {"depth_bytes", 2 * (frame.raw_disparity.size() + frame.depth.size())},
                             {"rgb_bytes", 3 * frame.color.size()}};
  return line.dump() + "\n";
}

std::vector<uint16_t> depth_units(const DeviceFrame& frame, const OptionalLine& line) {
  const DepthImage depth = depth_of(frame, line);
  std::vector<uint16_t> units(depth.size());
  std::ranges::transform(depth, units.begin(), [](float z) {
    const double unit = 1000 * z / kDepthUnit_mm + 0.5;  // std::round calls a function for each pixel
    constexpr double kTooFar = std::numeric_limits<uint16_t>::max() + 1.0;
    return unit >= 1 && unit < kTooFar ? static_cast<uint16_t>(unit) : uint16_t{0};
  });
  return units;
}

TrackResult parse_answer(std::string_view line, int number) {
  const std::string where = "answer";
  const nlohmann::json document = parse_json(line, where);
  const JsonCursor answer(document, where);
  answer.expect_keys({"frame"}, {"status", "angles_deg", "position_mm", "quaternion_wxyz", "joints_mm"});
  if (answer["frame"].integer(0, std::numeric_limits<int>::max()) != number)
    throw Error("an answer to another frame");
  TrackResult result;
  result.status = answer.has("status") ? answer["status"].one_of<TrackStatus>() : TrackStatus::tracked;
  if (result.status != TrackStatus::tracked) return result;
  result.has = {.posture = answer.has("angles_deg"),
                .pose = answer.has("position_mm") || answer.has("quaternion_wxyz"),
                .internals = false};
  if (result.has.posture) result.posture_unfiltered = posture_from(answer["angles_deg"]);
  if (result.has.pose)
    result.T_camera_hand_unfiltered = Eigen::Translation3d(answer["position_mm"].vector3(kMost_mm) / 1000) *
                                      rotation_from(answer["quaternion_wxyz"]);
  if (answer.has("joints_mm")) result.joints = joints_from(answer["joints_mm"]);
  if (!result.has.posture && !result.has.pose && result.joints.empty())
    answer.fail("no estimate", "angles_deg, position_mm and quaternion_wxyz, or joints_mm");
  return result;
}

}  // namespace glovebench
