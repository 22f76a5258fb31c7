#include <fmt/format.h>

#include <algorithm>

#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "core/base/text.h"
#include "eval/estimates/estimate_format.h"
#include "reports/text.h"

namespace glovebench::eval {
namespace {

/// What all frames share.
struct JointsFile {
  JointOrder order;
  std::string positions;  ///< their key: "joints_m"
  std::string time;       ///< its key: "time_s"
  double unit = 1;        ///< m
  double unit_us = 1;
};

/// "joints_mm" of the keys that begin with "joints".
std::string key_with(const JsonCursor& frame, std::string_view beginning) {
  for (const auto& [key, value] : frame.members())
    if (key.starts_with(beginning)) return key;
  frame.fail(fmt::format("a key that begins with {}", beginning));
}

/// "mm" of "joints_mm".
std::string unit_of(const std::string& key) {
  const size_t line = key.rfind('_');
  return line == std::string::npos ? "" : key.substr(line + 1);
}

JointOrder order_of(const JsonCursor& root, bool is_webxr, const EstimateFlags& flags) {
  const std::string named = is_webxr ? "webxr" : root.has("order") ? root["order"].text() : flags.order.name;
  if (named == flags.order.name && !named.empty()) return flags.order;
  if (!flags.order.name.empty())
    root.fail("order " + quoted_excerpt(named), flags.order.name + ", as --joints says");
  if (named.empty()) root.fail("no order of the joints", "\"order\", or --joints with a name or a map (*.json)");
  const auto found = std::ranges::find(joint_orders(), named, &JointOrder::name);
  if (found == joint_orders().end()) root["order"].fail("an order that `glovebench score --help` names");
  return *found;
}

/// Each joint of the order with its point; null where a frame lacks it.
std::vector<std::pair<int, JsonCursor>> points_of(const JsonCursor& joints, const JointOrder& order) {
  std::vector<std::pair<int, JsonCursor>> points;
  const auto add = [&](size_t index, const JsonCursor& point) {
    if (order.joints[index].joint >= 0 && !point.is_null()) points.emplace_back(order.joints[index].joint, point);
  };
  if (joints.value().is_array()) {
    const JsonItems items = joints.items(order.joints.size());
    for (size_t i = 0; i < items.size(); ++i) add(i, items[i]);
  } else {
    for (const auto& [name, point] : joints.members()) {
      const std::optional<size_t> index = order.find(name);
      if (!index) point.fail(quoted_excerpt(name), "a joint of " + order.name);
      add(*index, point);
    }
  }
  std::ranges::stable_sort(points, {}, &std::pair<int, JsonCursor>::first);
  return points;
}

void add_frame(const JsonCursor& frame, const JointsFile& file, EstimateSequence& sequence,
               const std::string& where, const std::string& field) {
  frame.expect_keys(std::to_array<std::string_view>({file.time}),
                    std::to_array<std::string_view>({file.positions}));
  constexpr double kLargest = 1e16;
  const int64_t time =
      timestamp_of(frame[file.time].number(-kLargest, kLargest), file.unit_us, where, field + ", time");
  if (!frame.has(file.positions) || frame[file.positions].is_null())
    return sequence.add(time, TrackStatus::missing, {}, where, field);
  const auto points = points_of(frame[file.positions], file.order);
  std::vector<int> joints;
  std::vector<double> numbers;
  for (const auto& [joint, point] : points) {
    const Eigen::Vector3d p = file.unit * point.vector3(1e9);
    joints.push_back(joint);
    numbers.insert(numbers.end(), p.begin(), p.end());
  }
  if (sequence.joints.empty()) sequence.joints = joints;
  if (sequence.joints != joints || joints.size() < 4)
    frame[file.positions].fail(
        reports::counted(joints.size(), "joint"),
        sequence.joints.size() < 4 ? "four or more" : "those of the first frame with a hand, or null");
  sequence.add(time, TrackStatus::tracked, numbers, where, field);
}

/// The document of guides/score.md, or a recording from WebXR (trajectories/README.md).
std::vector<EstimateSequence> read_joints(std::string_view bytes, const EstimateFlags& flags,
                                          const std::string& where) {
  const nlohmann::json document = parse_json(bytes, where);
  const JsonCursor root(document, where);
  root.expect_keys({"format", "version", "frames"}, {"order", "frame"});
  const bool is_webxr = root["format"].text() == "glovebench-webxr-joints";
  root.expect_format(is_webxr ? "glovebench-webxr-joints" : "glovebench-joints", 1);
  const JsonItems frames = root["frames"].some_items();
  JointsFile file{order_of(root, is_webxr, flags), "joints", key_with(frames[0], "time")};
  for (const JsonCursor& frame : frames)
    if (frame.members().size() > 1) {
      file.positions = key_with(frame, "joints");
      break;
    }
  const std::string unit = unit_of(file.positions);
  file.unit = meters_of(unit, flags.units, where, "unit of the joints");
  file.unit_us = microseconds_of(unit_of(file.time), flags.time, where, "unit of the time");
  std::vector<EstimateSequence> sequences(1);
  sequences[0].has = parts_of_joints(unit.empty() ? flags.units : unit,
                                     root.has("frame") ? root["frame"].text() : "", flags, where);
  sequences[0].order = file.order;
  sequences[0].reserve(frames.size());
  for (size_t i = 0; i < frames.size(); ++i)
    add_frame(frames[i], file, sequences[0], where, fmt::format("frames[{}]", i));
  return sequences;
}

}  // namespace

EstimateFormat joints_estimates() {
  return {.name = "joints",
          .description = "JSON with the joints of each frame, in a known order or by a map",
          .fits = [](std::string_view path, std::string_view) { return path.ends_with(".json"); },
          .read = read_joints};
}

}  // namespace glovebench::eval
