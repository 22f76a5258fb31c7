#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text.h"
#include "trajectories/formats/format.h"
#include "trajectories/text_cells.h"

namespace glovebench::trajectories {
namespace {

constexpr size_t kHeaderLines = 5;
constexpr size_t kLeading = 2;  ///< columns before the points: frame number and time

using Cells = std::vector<std::string_view>;

void expect_cell(const Cells& cells, size_t column, std::string_view expected, const std::string& where,
                 size_t line) {
  const std::string_view found = column < cells.size() ? cells[column] : std::string_view();
  if (found != expected) {
    throw Error(where, fmt::format("line {}, column {}", line, column + 1), quoted_excerpt(found),
                quoted_excerpt(expected));
  }
}

struct About {
  size_t frames = 0;
  size_t markers = 0;
  double unit = 0;  ///< m
};

/// The value of the second and third line: a name above each value.
std::string_view value_of(std::string_view name, const Cells& names, const Cells& values,
                          const std::string& where) {
  const auto found = std::ranges::find(names, name);
  const auto column = static_cast<size_t>(found - names.begin());
  if (column >= values.size())
    throw Error(where, fmt::format("lines 2 and 3, {}", name), "nothing", "a name and a value");
  return values[column];
}

About about_file(std::span<const std::string_view> lines, const std::string& where) {
  expect_cell(cells_of(lines[0], '\t'), 0, "PathFileType", where, 1);
  const Cells names = cells_of(lines[1], '\t'), values = cells_of(lines[2], '\t');
  const auto count = [&](std::string_view name, double max) {
    const std::string field = fmt::format("line 3, {}", name);
    const std::string_view cell = value_of(name, names, values, where);
    const double number = number_from(cell, 1, max, where, field);
    if (number != std::floor(number)) throw Error(where, field, quoted_excerpt(cell), "a whole number");
    return static_cast<size_t>(number);
  };
  const std::string_view units = value_of("Units", names, values, where);
  if (units != "mm" && units != "m") throw Error(where, "line 3, Units", quoted_excerpt(units), "mm or m");
  return {.frames = count("NumFrames", 1e9),
          .markers = count("NumMarkers", kMaxMarkers),
          .unit = units == "mm" ? 0.001 : 1.0};
}

void without_empty_end(Cells& cells) {
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
}

void read_names(std::span<const std::string_view> lines, size_t count, MarkerSequence& sequence,
                const std::string& where) {
  Cells names = cells_of(lines[3], '\t'), axes = cells_of(lines[4], '\t');
  expect_cell(names, 0, "Frame#", where, 4);
  expect_cell(names, 1, "Time", where, 4);
  without_empty_end(names);
  for (size_t c = kLeading; c < names.size(); ++c) {
    const std::string field = fmt::format("line 4, column {}", c + 1);
    const size_t axis = (c - kLeading) % 3;
    if (axis == 0) add_name(names[c], sequence, where, field);
    if (axis != 0 && !names[c].empty()) throw Error(where, field, quoted_excerpt(names[c]), "an empty cell");
  }
  if (sequence.names.size() != count)
    throw Error(where, "line 4", fmt::format("{} names", sequence.names.size()), fmt::format("{}", count));
  for (size_t c = 0; c < 3 * count; ++c)
    expect_cell(axes, kLeading + c, fmt::format("{}{}", "XYZ"[c % 3], c / 3 + 1), where, 5);
}

Eigen::Vector3d point_or_gap(std::span<const std::string_view> cells, double unit, const std::string& where,
                             const std::string& field) {
  const Eigen::Vector3d point = point_from(cells, unit, where, field);
  return point == Eigen::Vector3d::Zero() ? gap() : point;
}

MarkerFrame trc_frame(Cells cells, const About& about, const MarkerSequence& sequence, const std::string& where,
                      const std::string& line) {
  without_empty_end(cells);
  const size_t columns = kLeading + 3 * about.markers;
  if (cells.size() > columns)
    throw Error(where, line, fmt::format("{} cells", cells.size()), fmt::format("{}", columns));
  cells.resize(columns);  // the last points of a line may be missing
  number_from(cells[0], 0, 1e9, where, line + ", Frame#");
  MarkerFrame frame;
  frame.points.reserve(about.markers);
  frame.timestamp_us = timestamp_from(cells[1], where, line + ", Time");
  for (size_t m = 0; m < about.markers; ++m) {
    frame.points.push_back(point_or_gap(std::span(cells).subspan(kLeading + 3 * m, 3), about.unit, where,
                                        fmt::format("{}, {}", line, sequence.names[m])));
  }
  return frame;
}

/// The table of points that Motion Analysis' programs and OpenSim write: tabs between cells; three lines about the
/// file, of which units (mm or m) and numbers of markers and frames count; the names, a name over three columns;
/// X1, Y1, Z1, ...; then a line for each frame: its number, its time in s, the points. Three cells that are empty,
/// NaN or zero are a gap.
MarkerSequence parse_trc(std::string_view text, Side, const std::string& where) {
  Lines lines(text);
  std::array<std::string_view, kHeaderLines> header;
  for (std::string_view& line : header) {
    const std::optional<std::string_view> next = lines.next();
    if (!next) {
      throw Error(where, "lines", fmt::format("{}", lines.number()),
                  fmt::format("{} and the frames", kHeaderLines));
    }
    line = *next;
  }
  const About about = about_file(header, where);
  MarkerSequence sequence;
  read_names(header, about.markers, sequence, where);
  int64_t first_us = 0;
  while (const std::optional<std::string_view> text_line = lines.next()) {
    if (cells_of(*text_line, '\t').size() == 1 && trimmed(*text_line).empty()) continue;
    const std::string line = fmt::format("line {}", lines.number());
    MarkerFrame frame = trc_frame(cells_of(*text_line, '\t'), about, sequence, where, line);
    if (sequence.frames.empty()) first_us = frame.timestamp_us;
    add_frame(std::move(frame), first_us, text.size(), sequence, where, line + ", Time");
  }
  if (sequence.frames.size() != about.frames) {
    throw Error(where, "frames", fmt::format("{}", sequence.frames.size()),
                fmt::format("{}, the NumFrames of line 3", about.frames));
  }
  return sequence;
}

}  // namespace

Format trc_format() {
  return {.name = "trc",
          .ending = ".trc",
          .description = "the table of Motion Analysis' programs and OpenSim",
          .markers = parse_trc};
}

}  // namespace glovebench::trajectories
