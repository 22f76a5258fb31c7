#include "eval/estimates/joint_orders.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "core/base/registry.h"
#include "core/hand/skeleton.h"

namespace glovebench::eval {
namespace {

/// `names`: with blanks between them.
JointOrder make_order(const std::string& name, const std::vector<int>& joints, const std::string& names) {
  JointOrder order{name, {}};
  std::istringstream words(names);
  for (const int joint : joints) {
    words >> order.joints.emplace_back(NamedJoint{{}, joint}).name;
    check(!words.fail(), "a joint order has as many names as joints");
  }
  return order;
}

JointOrder webxr_order() {
  JointOrder order{"webxr", {}};
  for (int joint = 0; joint < kForearmJoint; ++joint) order.joints.push_back({joint_name(joint), joint});
  return order;
}

constexpr const char* kManoNames =
    "wrist index1 index2 index3 middle1 middle2 middle3 pinky1 pinky2 pinky3 ring1 ring2 ring3 thumb1 thumb2 "
    "thumb3 "
    "thumb_tip index_tip middle_tip ring_tip pinky_tip";

std::vector<JointOrder> make_orders() {
  return {
      make_order("mediapipe", {0, 1, 2, 3, 4, 6, 7, 8, 9, 11, 12, 13, 14, 16, 17, 18, 19, 21, 22, 23, 24},
                 "WRIST THUMB_CMC THUMB_MCP THUMB_IP THUMB_TIP INDEX_FINGER_MCP INDEX_FINGER_PIP INDEX_FINGER_DIP "
                 "INDEX_FINGER_TIP MIDDLE_FINGER_MCP MIDDLE_FINGER_PIP MIDDLE_FINGER_DIP MIDDLE_FINGER_TIP "
                 "RING_FINGER_MCP RING_FINGER_PIP RING_FINGER_DIP RING_FINGER_TIP PINKY_MCP PINKY_PIP PINKY_DIP "
                 "PINKY_TIP"),
      webxr_order(),
      make_order(
          "openxr", {-1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24},
          "PALM WRIST THUMB_METACARPAL THUMB_PROXIMAL THUMB_DISTAL THUMB_TIP INDEX_METACARPAL INDEX_PROXIMAL "
          "INDEX_INTERMEDIATE INDEX_DISTAL INDEX_TIP MIDDLE_METACARPAL MIDDLE_PROXIMAL MIDDLE_INTERMEDIATE "
          "MIDDLE_DISTAL MIDDLE_TIP RING_METACARPAL RING_PROXIMAL RING_INTERMEDIATE RING_DISTAL RING_TIP "
          "LITTLE_METACARPAL LITTLE_PROXIMAL LITTLE_INTERMEDIATE LITTLE_DISTAL LITTLE_TIP"),
      make_order("mano16", {0, 6, 7, 8, 11, 12, 13, 21, 22, 23, 16, 17, 18, 1, 2, 3}, kManoNames),
      make_order("mano21", {0, 6, 7, 8, 11, 12, 13, 21, 22, 23, 16, 17, 18, 1, 2, 3, 4, 9, 14, 19, 24}, kManoNames),
      make_order("hot3d", {4, 9, 14, 19, 24, 0, 2, 3, 6, 7, 8, 11, 12, 13, 16, 17, 18, 21, 22, 23},
                 "THUMB_FINGERTIP INDEX_FINGERTIP MIDDLE_FINGERTIP RING_FINGERTIP PINKY_FINGERTIP WRIST "
                 "THUMB_INTERMEDIATE THUMB_DISTAL INDEX_PROXIMAL INDEX_INTERMEDIATE INDEX_DISTAL MIDDLE_PROXIMAL "
                 "MIDDLE_INTERMEDIATE MIDDLE_DISTAL RING_PROXIMAL RING_INTERMEDIATE RING_DISTAL PINKY_PROXIMAL "
                 "PINKY_INTERMEDIATE PINKY_DISTAL")};
}

/// -1 for null.
int webxr_joint(const JsonCursor& value, std::vector<int>& known) {
  if (value.is_null()) return -1;
  const std::string name = value.text();
  int joint = 0;
  while (joint < kForearmJoint && joint_name(joint) != name) ++joint;
  if (joint == kForearmJoint) value.fail("the name of a WebXR hand joint, or null");
  if (std::ranges::find(known, joint) != known.end()) value.fail("each joint once");
  known.push_back(joint);
  return joint;
}

}  // namespace

std::optional<size_t> JointOrder::find(std::string_view word) const {
  for (size_t i = 0; i < joints.size(); ++i)
    if (joints[i].name == word || std::to_string(i) == word) return i;
  return {};
}

std::span<const JointOrder> joint_orders() {
  static const std::vector<JointOrder> orders = make_orders();
  return orders;
}

JointOrder load_joint_order(const std::string& name_or_file) {
  if (!name_or_file.ends_with(".json")) return find_in(joint_orders(), name_or_file, "--joints", "order");
  return parse_joint_map(read_file(name_or_file, kLargestJointMap), name_or_file);
}

JointOrder parse_joint_map(std::string_view text, const std::string& where) {
  constexpr size_t kMostJoints = 200;
  const nlohmann::json document = parse_json(text, where);
  const JsonCursor root(document, where);
  root.expect_keys({"format", "version", "joints"});
  root.expect_format("glovebench-joint-map", 1);
  JointOrder order{"the map", {}};
  std::vector<int> known;
  const JsonCursor joints = root["joints"];
  const bool is_list = joints.value().is_array();
  if (joints.value().size() > kMostJoints) joints.fail(fmt::format("at most {} joints", kMostJoints));
  if (is_list)
    for (const JsonCursor& item : joints.items())
      order.joints.push_back({std::to_string(order.joints.size()), webxr_joint(item, known)});
  else
    for (const auto& [name, item] : joints.members()) order.joints.push_back({name, webxr_joint(item, known)});
  if (known.size() < 4) joints.fail("the names of four hand joints or more");
  return order;
}

}  // namespace glovebench::eval
