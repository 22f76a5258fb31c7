#include "trajectories/capture/marker_places.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "core/base/text.h"

namespace glovebench::trajectories {
namespace {

constexpr const char* kLayoutFormat = "glovebench-marker-layout";
constexpr int kLayoutVersion = 1;

/// A marker on the skin in one direction from a point of a bone.
struct Place {
  int joint;            ///< in whose frame it is fixed
  int from;             ///< the bone begins at this joint ...
  int to;               ///< ... and ends at this one
  double along;         ///< share of the way between them
  Eigen::Vector3d out;  ///< direction to the skin, in the frame of `joint`
  Eigen::Vector3d deviation;
};

// Fixed before any error was looked at: people put markers onto the middle of a segment by eye; along a bone they
// miss by more than across, and the skin has one height.
const Eigen::Vector3d kOnFinger(0.002, 0.0015, 0.004), kOnPalm(0.005, 0.002, 0.005), kOnSide(0.003, 0.005, 0.005);

/// The mesh's tip joints lie in the middle of the last segment, 11 to 15 mm from its joint: shares of that.
constexpr double kMiddleOfLast = 0.9, kNail = 1.6;

const std::map<std::string, Place>& places() {
  static const std::map<std::string, Place> table = [] {
    const Eigen::Vector3d dorsal = Eigen::Vector3d::UnitY(), ulnar = Eigen::Vector3d::UnitX();
    std::map<std::string, Place> result = {
        {"thumb_metacarpal", {1, 1, 2, 0.5, dorsal, kOnFinger}},
        {"thumb_proximal", {2, 2, 3, 0.5, dorsal, kOnFinger}},
        {"thumb_distal", {3, 3, 4, kMiddleOfLast, dorsal, kOnFinger}},
        {"thumb_tip", {3, 3, 4, kNail, dorsal, kOnFinger}},
        {"hand_back", {kPalm, kWristJoint, 11, 0.5, dorsal, kOnPalm}},
        {"wrist", {kPalm, kWristJoint, 11, 0, dorsal, kOnPalm}},
        {"wrist_radial", {kPalm, kWristJoint, 11, 0, -ulnar, kOnSide}},
        {"wrist_ulnar", {kPalm, kWristJoint, 11, 0, ulnar, kOnSide}},
    };
    constexpr std::array<const char*, 4> fingers = {"index", "middle", "ring", "little"};
    for (int f = 0; f < 4; ++f) {
      const int mcp = 6 + 5 * f;
      const std::string finger = fingers[static_cast<size_t>(f)];
      result[finger + "_knuckle"] = {kPalm, mcp, mcp + 1, 0, dorsal, kOnPalm};
      result[finger + "_proximal"] = {mcp, mcp, mcp + 1, 0.5, dorsal, kOnFinger};
      result[finger + "_intermediate"] = {mcp + 1, mcp + 1, mcp + 2, 0.5, dorsal, kOnFinger};
      result[finger + "_distal"] = {mcp + 2, mcp + 2, mcp + 3, kMiddleOfLast, dorsal, kOnFinger};
      result[finger + "_tip"] = {mcp + 2, mcp + 2, mcp + 3, kNail, dorsal, kOnFinger};
    }
    // 4 cm up the forearm.
    result["forearm"] = {kForearmJoint, kWristJoint, 11, -0.45, dorsal, kOnPalm};
    result["forearm_radial"] = {kForearmJoint, kWristJoint, 11, -0.45, -ulnar, kOnSide};
    result["forearm_ulnar"] = {kForearmJoint, kWristJoint, 11, -0.45, ulnar, kOnSide};
    return result;
  }();
  return table;
}

/// The distance along the ray to the nearest triangle; nothing if it meets none (Moeller and Trumbore 1997).
std::optional<double> hit_distance(const HandModel& model, const PosedHand& hand, const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction) {
  std::optional<double> nearest;
  for (const Triangle& triangle : model.triangles()) {
    const auto corner = [&](size_t i) { return hand.vertices[triangle.vertices[i]].cast<double>().eval(); };
    const Eigen::Vector3d a = corner(0), u = corner(1) - a, v = corner(2) - a, h = direction.cross(v);
    const double determinant = u.dot(h);
    if (std::abs(determinant) < 1e-18) continue;
    const Eigen::Vector3d s = origin - a, q = s.cross(u);
    const double alpha = s.dot(h) / determinant, beta = direction.dot(q) / determinant, t = v.dot(q) / determinant;
    if (alpha < 0 || beta < 0 || alpha + beta > 1 || t <= 0) continue;
    nearest = std::min(nearest.value_or(t), t);
  }
  return nearest;
}

PlacedMarker on_skin(const Place& place, const HandModel& model) {
  PosedHand hand = model.pose(Posture::Zero());
  const Eigen::Isometry3d T_hand_place =
      place.joint == kPalm ? Eigen::Isometry3d::Identity() : hand.T_hand_joint[static_cast<size_t>(place.joint)];
  const auto joint_at = [&](int j) { return hand.T_hand_joint[static_cast<size_t>(j)].translation(); };
  const Eigen::Vector3d on_bone = joint_at(place.from) + place.along * (joint_at(place.to) - joint_at(place.from));
  const Eigen::Vector3d direction = T_hand_place.linear() * place.out;
  const double height = hit_distance(model, hand, on_bone, direction).value_or(0.0);
  PlacedMarker marker;
  marker.joint = place.joint;
  marker.offset = T_hand_place.inverse() * (on_bone + height * direction);
  marker.deviation = place.deviation;
  return marker;
}

/// "index_proximal" of "index_proximal_2".
std::string without_number(const std::string& name) {
  const size_t underscore = name.find_last_of('_');
  const bool numbered = underscore != std::string::npos && underscore + 1 < name.size() &&
                        name.find_first_not_of("0123456789", underscore + 1) == std::string::npos;
  return numbered ? name.substr(0, underscore) : name;
}

std::string known_places() {
  std::string names;
  for (const auto& [name, place] : places()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

}  // namespace

bool is_webxr_joint(const std::string& name) {
  for (int j = 0; j < kWebxrJointCount; ++j)
    if (joint_name(j) == name) return true;
  return false;
}

MarkerSequence sequence_of_joints() {
  MarkerSequence sequence;
  for (int j = 0; j < kWebxrJointCount; ++j) sequence.names.push_back(joint_name(j));
  return sequence;
}

MarkerLayout parse_marker_layout(std::string_view text, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  const JsonCursor root(document, where);
  root.expect_keys({"format", "version", "markers"});
  root.expect_format(kLayoutFormat, kLayoutVersion);
  MarkerLayout layout;
  for (const auto& [name, marker] : root["markers"].members()) {
    const std::string place = marker.text();
    if (!is_webxr_joint(place) && !places().contains(without_number(place)))
      marker.fail("one of " + known_places() + ", or a WebXR hand joint");
    layout[name] = place;
  }
  return layout;
}

MarkerLayout load_marker_layout(const std::string& path) {
  constexpr uint64_t kLargest = uint64_t{1} << 20;  // bytes
  return path.empty() ? MarkerLayout{} : parse_marker_layout(read_file(path, kLargest), path);
}

std::optional<PlacedMarker> place_marker(const std::string& name, const HandModel& model) {
  PlacedMarker marker;
  if (is_webxr_joint(name)) {
    marker.joint = joint_index(name);
  } else {
    const auto place = places().find(without_number(name));
    if (place == places().end()) return {};
    marker = on_skin(place->second, model);
  }
  marker.name = name;
  return marker;
}

std::vector<PlacedMarker> place_markers(const std::vector<std::string>& names, const MarkerLayout& layout,
                                        const HandModel& model, const std::string& where) {
  for (const auto& [name, place] : layout)
    if (std::ranges::find(names, name) == names.end())
      throw Error(where, "points", "none named " + quoted_excerpt(name), "all points of the layout");
  std::vector<PlacedMarker> markers;
  for (const std::string& name : names) {
    if (is_unlabeled(name)) continue;
    const auto named = layout.find(name);
    std::optional<PlacedMarker> marker = place_marker(named == layout.end() ? name : named->second, model);
    if (!marker) {
      throw Error(where, "point", quoted_excerpt(name),
                  "a place on the hand (trajectories/README.md) or a layout that says it");
    }
    marker->name = name;
    markers.push_back(std::move(*marker));
  }
  return markers;
}

}  // namespace glovebench::trajectories
