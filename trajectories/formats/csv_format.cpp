#include <fmt/format.h>

#include <array>

#include "core/base/error.h"
#include "core/base/text.h"
#include "trajectories/formats/format.h"
#include "trajectories/text_cells.h"

namespace glovebench::trajectories {
namespace {

constexpr std::string_view kTime = "time_s";
constexpr std::array<std::string_view, 3> kAxes = {"_x", "_y", "_z"};

/// "index_tip" of "index_tip_x_mm", `axis` "_x" and `unit` "_mm".
std::string_view point_name(std::string_view heading, std::string_view axis, std::string_view unit,
                            const std::string& where, const std::string& field) {
  const std::string ending = fmt::format("{}{}", axis, unit);
  if (!heading.ends_with(ending) || heading.size() == ending.size())
    throw Error(where, field, quoted_excerpt(heading), fmt::format("a name with the ending {}", ending));
  return heading.substr(0, heading.size() - ending.size());
}

/// Adds the names of the headings; the unit of the points, in metres.
double read_headings(const std::vector<std::string_view>& headings, MarkerSequence& sequence,
                     const std::string& where) {
  if (headings.front() != kTime)
    throw Error(where, "line 1, column 1", quoted_excerpt(headings.front()), quoted_excerpt(kTime));
  if (headings.size() < 4 || headings.size() % 3 != 1)
    throw Error(where, "line 1", fmt::format("{} columns", headings.size()), "time_s and three for each point");
  const std::string_view unit = headings[1].ends_with("_mm") ? "_mm" : "_m";
  for (size_t c = 1; c < headings.size(); ++c) {
    const std::string field = fmt::format("line 1, column {}", c + 1);
    const size_t axis = (c - 1) % 3;
    const std::string_view name = point_name(headings[c], kAxes[axis], unit, where, field);
    if (axis == 0) add_name(name, sequence, where, field);
    if (name != sequence.names.back()) {
      throw Error(where, field, quoted_excerpt(headings[c]),
                  fmt::format("\"{}{}{}\"", sequence.names.back(), kAxes[axis], unit));
    }
  }
  return unit == "_mm" ? 0.001 : 1.0;
}

/// The headings `time_s`, then NAME_x_mm, NAME_y_mm, NAME_z_mm for each point (or all in _m), and a line for each
/// frame. Three cells that are empty or NaN are a gap.
MarkerSequence parse_csv(std::string_view text, Side, const std::string& where) {
  Lines lines(text);
  MarkerSequence sequence;
  const double unit = read_headings(cells_of(*lines.next(), ','), sequence, where);
  int64_t first_us = 0;
  while (const auto row = next_row(lines, 3 * sequence.names.size() + 1, where)) {
    const auto& [cells, line] = *row;
    MarkerFrame frame;
    frame.points.reserve(sequence.names.size());
    frame.timestamp_us = timestamp_from(cells[0], where, fmt::format("{}, {}", line, kTime));
    for (size_t m = 0; m < sequence.names.size(); ++m) {
      frame.points.push_back(point_from(std::span(cells).subspan(1 + 3 * m, 3), unit, where,
                                        fmt::format("{}, {}", line, sequence.names[m])));
    }
    if (sequence.frames.empty()) first_us = frame.timestamp_us;
    add_frame(std::move(frame), first_us, text.size(), sequence, where, fmt::format("{}, {}", line, kTime));
  }
  if (sequence.frames.empty()) throw Error(where, "frames", "none", "at least one line below the headings");
  return sequence;
}

}  // namespace

std::string csv_markers(const MarkerSequence& sequence) {
  std::string text(kTime);
  for (const std::string& name : sequence.names) text += fmt::format(",{0}_x_mm,{0}_y_mm,{0}_z_mm", name);
  text += "\n";
  for (const MarkerFrame& frame : sequence.frames) {
    text += fixed(static_cast<double>(frame.timestamp_us) / 1e6, 6);
    for (const Eigen::Vector3d& p : frame.points)
      for (int i = 0; i < 3; ++i) text.append(",") += is_seen(p) ? fixed(1000 * p[i], 3) : "";
    text += "\n";
  }
  return text;
}

Format csv_format() {
  return {.name = "csv",
          .ending = ".csv",
          .description = "time_s, then NAME_x_mm, NAME_y_mm, NAME_z_mm or _m",
          .markers = parse_csv};
}

}  // namespace glovebench::trajectories
