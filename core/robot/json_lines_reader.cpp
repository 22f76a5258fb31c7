#include "core/robot/json_lines_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/angles.h"
#include "core/base/error.h"
#include "core/base/excerpt.h"
#include "core/base/file.h"
#include "core/base/parse_json.h"

namespace glovebench {
namespace {

using nlohmann::json;

constexpr double kWrittenUnitTolerance = 1e-5;  // the four numbers are rounded to 1e-6

constexpr double kLargestNumber = 1e9;  // of any unit: no angle or place, but far from what overflows

/// A value in the line and the way to it.
class Field {
 public:
  Field(const json& value, const std::string& where, std::string path)
      : value_(value), where_(where), path_(std::move(path)) {}

  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw Error(where_, path_, found, expected);
  }
  [[noreturn]] void fail(const std::string& expected) const { fail(excerpt(value_), expected); }

  /// The value is an object with these keys and no others.
  template <typename Keys>
  void expect_keys(const Keys& keys) const {
    if (!value_.is_object()) fail("an object");
    for (const std::string_view key : keys)
      if (!value_.contains(std::string(key))) fail("no key \"" + std::string(key) + "\"", "the key");
    for (const auto& [key, unused] : value_.items())
      if (std::ranges::find(keys, key) == std::ranges::end(keys))
        fail("unknown key \"" + printable(key) + "\"", "only the documented keys");
  }
  Field operator[](std::string_view key) const {
    return {value_.at(std::string(key)), where_,
            path_ == "line" ? std::string(key) : path_ + "." + std::string(key)};
  }
  std::vector<Field> items(std::optional<size_t> count = {}) const {
    if (!value_.is_array()) fail("an array");
    if (count && value_.size() != *count)
      fail(fmt::format("{} elements", value_.size()), fmt::format("{}", *count));
    std::vector<Field> items;
    for (size_t i = 0; i < value_.size(); ++i)
      items.emplace_back(value_[i], where_, fmt::format("{}[{}]", path_, i));
    return items;
  }
  const json& value() const { return value_; }
  bool is_null() const { return value_.is_null(); }
  bool boolean() const {
    if (!value_.is_boolean()) fail("true or false");
    return value_.get<bool>();
  }
  double number() const {
    if (!value_.is_number()) fail("a number");
    const double number = value_.get<double>();
    if (!(std::abs(number) <= kLargestNumber)) fail(fmt::format("a number from -{0} to {0}", kLargestNumber));
    return number;
  }
  int64_t integer(int64_t min) const {
    const bool signed_64 =
        value_.is_number_integer() &&
        (!value_.is_number_unsigned() || value_.get<uint64_t>() <= static_cast<uint64_t>(INT64_MAX));
    if (!signed_64 || value_.get<int64_t>() < min) fail(fmt::format("a whole number from {}", min));
    return value_.get<int64_t>();
  }
  /// The one of `count` values whose name this is.
  template <typename Kind>
  Kind kind(int count, const char* expected) const {
    for (int i = 0; value_.is_string() && i < count; ++i)
      if (to_string(static_cast<Kind>(i)) == value_.get_ref<const std::string&>()) return static_cast<Kind>(i);
    fail(expected);
  }

 private:
  const json& value_;
  const std::string& where_;
  std::string path_;
};

json parse_document(std::string_view line, const std::string& where) {
  if (line.size() > kLongestCommandLine)
    throw Error(where, "line", fmt::format("{} bytes", line.size()),
                fmt::format("at most {}", kLongestCommandLine));
  return parse_json(line, where);
}

template <typename Infos>
std::vector<std::string_view> names_of(const Infos& infos) {
  std::vector<std::string_view> names;
  for (const auto& info : infos) names.push_back(info.name);
  return names;
}

template <typename Infos, typename Values>
void read_angles(const Field& field, const Infos& infos, Values& values) {
  field.expect_keys(names_of(infos));
  for (size_t i = 0; i < infos.size(); ++i) values[i] = radians_from_degrees(field[infos[i].name].number());
}

template <typename Infos, typename Values, typename Flags>
void read_targets(const Field& field, const Infos& infos, Values& values, Flags& clamped) {
  field.expect_keys(std::array<std::string_view, 2>{"target_deg", "clamped"});
  read_angles(field["target_deg"], infos, values);
  const std::vector<std::string_view> names = names_of(infos);
  for (const Field& item : field["clamped"].items()) {
    const auto found = item.value().is_string()
                           ? std::ranges::find(names, item.value().get_ref<const std::string&>())
                           : names.end();
    if (found == names.end()) item.fail("the name of one of the targets");
    bool& flag = clamped[static_cast<size_t>(found - names.begin())];
    if (flag) item.fail("a name twice", "each name once");
    flag = true;
  }
}

Eigen::Isometry3d read_pose(const Field& field) {
  field.expect_keys(std::array<std::string_view, 2>{"position_m", "rotation_wxyz"});
  const std::vector<Field> p = field["position_m"].items(3), q = field["rotation_wxyz"].items(4);
  const Eigen::Quaterniond rotation(q[0].number(), q[1].number(), q[2].number(), q[3].number());
  if (!(std::abs(rotation.norm() - 1) < kWrittenUnitTolerance))
    field["rotation_wxyz"].fail(fmt::format("length {}", rotation.norm()), "a unit quaternion");
  return Eigen::Translation3d(p[0].number(), p[1].number(), p[2].number()) * rotation.normalized();
}

std::optional<RobotTargets> read_all_targets(const Field& root) {
  const bool none = root["base_hand"].is_null();
  for (const char* key : {"actuators", "joints"})
    if (root[key].is_null() != none)
      root[key].fail(none ? "null, as base_hand is" : "targets, as base_hand has a pose");
  if (none && !root["arm"].is_null()) root["arm"].fail("null, as base_hand is");
  if (none) return std::nullopt;
  RobotTargets targets;
  read_targets(root["actuators"], shadow_actuator_infos(), targets.hand.actuators, targets.hand.actuator_clamped);
  read_targets(root["joints"], shadow_joint_infos(), targets.hand.joints, targets.hand.joint_clamped);
  targets.T_base_hand = read_pose(root["base_hand"]);
  if (root["arm"].is_null()) return targets;
  root["arm"].expect_keys(std::array<std::string_view, 1>{"target_deg"});
  targets.arm.emplace();
  read_angles(root["arm"]["target_deg"], arm_joint_infos(), *targets.arm);
  return targets;
}

Interventions read_interventions(const Field& field) {
  if (!field.value().is_object()) field.fail("an object");
  Interventions interventions;
  for (const auto& [name, unused] : field.value().items()) {
    int i = 0;
    while (i < kInterventionCount && to_string(static_cast<Intervention>(i)) != name) ++i;
    if (i == kInterventionCount) field.fail("unknown key \"" + printable(name) + "\"", "kinds of interventions");
    interventions.add(static_cast<Intervention>(i), field[name].integer(1));
  }
  return interventions;
}

}  // namespace

RobotCommand parse_command_line(std::string_view line, const std::string& where) {
  const json document = parse_document(line, where);
  const Field root(document, where, "line");
  root.expect_keys(std::array<std::string_view, 10>{"frame_timestamp_us", "timestamp_us", "status", "hold", "state",
                                                    "interventions", "actuators", "joints", "base_hand", "arm"});
  RobotCommand command;
  command.frame_timestamp_us = root["frame_timestamp_us"].integer(INT64_MIN);
  command.timestamp_us = root["timestamp_us"].integer(INT64_MIN);
  command.status = root["status"].kind<TrackStatus>(kTrackStatusCount, "a status of the tracker");
  command.hold = root["hold"].boolean();
  command.state = root["state"].kind<CommandState>(kCommandStateCount, "following, holding or stopped");
  const bool follows = command.state == CommandState::following;
  if (command.hold == follows)
    root["hold"].fail(follows ? "false with state following" : "true with another state");
  command.interventions = read_interventions(root["interventions"]);
  command.targets = read_all_targets(root);
  if (follows && !command.targets) root["base_hand"].fail("a pose with state following");
  return command;
}

std::vector<RobotCommand> read_command_lines(const std::string& path) {
  std::vector<RobotCommand> commands;
  const std::string text = read_file(path, kLargestCommandFile);
  for (size_t begin = 0, number = 1; begin < text.size(); ++number) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string where = fmt::format("{}:{}", path, number);
    commands.push_back(parse_command_line(std::string_view(text).substr(begin, end - begin), where));
    const size_t count = commands.size();
    if (count > 1 && commands[count - 1].timestamp_us <= commands[count - 2].timestamp_us)
      throw Error(where, "timestamp_us", fmt::format("{}", commands[count - 1].timestamp_us),
                  fmt::format("more than {}, that of the line before", commands[count - 2].timestamp_us));
    begin = end + 1;
  }
  return commands;
}

}  // namespace glovebench
