#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/base/text.h"
#include "eval/estimates/estimate_format.h"
#include "reports/text.h"
#include "trajectories/text_cells.h"

namespace glovebench::eval {
namespace {

using Cells = std::vector<std::string_view>;

/// A number of a frame: its column, and the factor to m or rad.
struct Source {
  size_t column = 0;
  double factor = 1;
};

/// The columns that the headings name.
struct Columns {
  Source time;                  ///< factor to us
  std::vector<Source> numbers;  ///< in the order of EstimateSequence::numbers
};

/// "wrist_x_mm" is "wrist_x" with the unit "mm", and "wrist_x" has none.
std::pair<std::string, std::string> name_and_unit(std::string_view heading) {
  for (const std::string_view unit : {"us", "ms", "s", "m", "cm", "mm", "deg", "rad"}) {
    const std::string ending = fmt::format("_{}", unit);
    if (heading.ends_with(ending) && heading.size() > ending.size())
      return {std::string(heading.substr(0, heading.size() - ending.size())), std::string(unit)};
  }
  return {std::string(heading), ""};
}

class Headings {
 public:
  Headings(const Cells& headings, const EstimateFlags& flags, const std::string& where)
      : flags_(flags), where_(where), taken_(headings.size()) {
    for (const std::string_view heading : headings) names_.push_back(name_and_unit(heading));
  }

  Columns read(EstimateSequence& sequence) {
    Columns columns;
    columns.time = take_time();
    sequence.has.posture = take(std::string(angle_infos()[0].name)).has_value();
    if (sequence.has.posture) add_angles(columns);
    sequence.has.pose = take("position_x").has_value();
    if (sequence.has.pose) add_pose(columns);
    add_joints(columns, sequence);
    require_all_taken(sequence);
    return columns;
  }

 private:
  std::optional<size_t> take(const std::string& name) {
    const auto found = std::ranges::find(names_, name, &std::pair<std::string, std::string>::first);
    if (found == names_.end()) return {};
    taken_[static_cast<size_t>(found - names_.begin())] = true;
    return found - names_.begin();
  }
  size_t need(const std::string& name) {
    const std::optional<size_t> column = take(name);
    if (!column) throw Error(where_, "line 1, column " + name, "nothing", "a column of that name");
    return *column;
  }
  const std::string& unit(size_t column) const { return names_[column].second; }
  static std::string field(size_t column) { return fmt::format("line 1, column {}", column + 1); }

  Source take_time() {
    std::optional<size_t> column = take("time");
    if (!column) column = take("timestamp");
    if (!column) throw Error(where_, "line 1", "no time", "a column time_s, time_ms, timestamp_us or time");
    return {*column, microseconds_of(unit(*column), flags_.time, where_, field(*column))};
  }
  void add_angles(Columns& columns) {
    for (const AngleInfo& info : angle_infos()) {
      const size_t column = need(std::string(info.name));
      if (unit(column) != "deg" && unit(column) != "rad")
        throw Error(where_, field(column), "no unit", fmt::format("{0}_deg or {0}_rad", info.name));
      columns.numbers.push_back({column, unit(column) == "deg" ? radians_from_degrees(1) : 1});
    }
  }
  Source length(size_t column) {
    const double meters = meters_of(unit(column), flags_.units, where_, field(column));
    if (unit(column).empty()) units_ = flags_.units;
    return {column, meters};
  }
  void add_pose(Columns& columns) {
    for (const char* name : {"position_x", "position_y", "position_z"})
      columns.numbers.push_back(length(need(name)));
    if (units_ == "none")
      throw Error(where_, "--units", "none", "a unit, since the file has positions of the hand");
    for (const char* name : {"quaternion_w", "quaternion_x", "quaternion_y", "quaternion_z"})
      columns.numbers.push_back({need(name), 1});
  }
  void add_joints(Columns& columns, EstimateSequence& sequence) {
    const std::vector<NamedJoint>& joints = flags_.order.joints;
    for (size_t i = 0; i < joints.size(); ++i) {
      std::string name = joints[i].name;
      if (std::ranges::find(names_, name + "_x", &std::pair<std::string, std::string>::first) == names_.end())
        name = std::to_string(i);
      const std::optional<size_t> x = take(name + "_x");
      if (!x) continue;
      const std::array axes = {*x, need(name + "_y"), need(name + "_z")};
      if (joints[i].joint < 0) continue;
      sequence.joints.push_back(joints[i].joint);
      for (const size_t column : axes) columns.numbers.push_back(length(column));
    }
    if (sequence.joints.empty()) return;
    sequence.order = flags_.order;
    const EstimateParts parts = parts_of_joints(units_, "", flags_, where_);
    sequence.has.place = parts.place;
    sequence.has.scale = parts.scale;
    if (sequence.joints.size() < 4)
      throw Error(where_, "line 1", reports::counted(sequence.joints.size(), "joint"), "four or more");
  }
  void require_all_taken(const EstimateSequence& sequence) const {
    for (size_t column = 0; column < taken_.size(); ++column) {
      if (taken_[column]) continue;
      throw Error(where_, field(column), quoted_excerpt(names_[column].first),
                  flags_.order.name.empty()
                      ? "a column of time, angles or pose, or --joints with the order of the joints"
                      : "a column of time, angles or pose, or a joint of " + flags_.order.name);
    }
    if (sequence.numbers_per_frame() == 0) throw Error(where_, "line 1", "time alone", "angles, a pose or joints");
  }

  const EstimateFlags& flags_;
  const std::string& where_;
  std::vector<std::pair<std::string, std::string>> names_;
  std::vector<bool> taken_;
  std::string units_;
};

void add_row(const Cells& cells, const Columns& columns, EstimateSequence& sequence, const std::string& where,
             const std::string& field) {
  constexpr double kLargest = 1e16, kLargestAngle = 1e4;
  const double time =
      trajectories::number_from(cells[columns.time.column], -kLargest, kLargest, where, field + ", time");
  const int64_t time_us = timestamp_of(time, columns.time.factor, where, field + ", time");
  const bool is_lost =
      std::ranges::all_of(columns.numbers, [&](const Source& source) { return cells[source.column].empty(); });
  if (is_lost) return sequence.add(time_us, TrackStatus::missing, {}, where, field);
  std::vector<double> numbers;
  numbers.reserve(columns.numbers.size());
  for (const Source& source : columns.numbers) {
    const bool is_angle = sequence.has.posture && numbers.size() < kAngleCount;
    const double most = is_angle ? kLargestAngle : 1e9;
    numbers.push_back(source.factor *
                      trajectories::number_from(cells[source.column], -most, most, where,
                                                fmt::format("{}, column {}", field, source.column + 1)));
  }
  sequence.add(time_us, TrackStatus::tracked, numbers, where, field);
}

/// CSV with headings (guides/score.md). A lost frame has empty cells.
std::vector<EstimateSequence> read_columns(std::string_view bytes, const EstimateFlags& flags,
                                           const std::string& where) {
  trajectories::Lines lines(bytes);
  const Cells headings = trajectories::cells_of(*lines.next(), ',');
  std::vector<EstimateSequence> sequences(1);
  const Columns columns = Headings(headings, flags, where).read(sequences[0]);
  sequences[0].reserve(static_cast<size_t>(std::ranges::count(bytes, '\n')));
  while (const auto row = trajectories::next_row(lines, headings.size(), where))
    add_row(row->cells, columns, sequences[0], where, row->place);
  return sequences;
}

}  // namespace

EstimateFormat columns_estimates() {
  return {.name = "columns",
          .description = "CSV with a time and angles, a pose or joints; its headings say names and units",
          .fits =
              [](std::string_view path, std::string_view first_line) {
                return path.ends_with(".csv") && !first_line.starts_with("seed,");
              },
          .read = read_columns};
}

}  // namespace glovebench::eval
