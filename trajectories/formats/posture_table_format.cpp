#include <fmt/format.h>

#include <set>

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/base/text.h"
#include "trajectories/formats/format.h"
#include "trajectories/posture_file.h"
#include "trajectories/text_cells.h"

namespace glovebench::trajectories {
namespace {

void expect_headings(const std::vector<std::string_view>& headings, const std::string& where) {
  constexpr size_t column_count = kAngleCount + 1;
  if (headings.size() != column_count) {
    throw Error(where, "line 1", fmt::format("{} columns", headings.size()),
                fmt::format("{}: name and the {} angles", column_count, kAngleCount));
  }
  for (size_t c = 0; c < column_count; ++c) {
    const std::string_view expected = c == 0 ? "name" : angle_infos()[c - 1].name;
    if (headings[c] != expected) {
      throw Error(where, fmt::format("line 1, column {}", c + 1), quoted_excerpt(headings[c]),
                  quoted_excerpt(expected));
    }
  }
}

/// The angle in a cell, radians.
double angle_from(std::string_view cell, const AngleInfo& info, const std::string& where, size_t line) {
  return radians_from_degrees(
      number_from(cell, info.min_deg, info.max_deg, where, fmt::format("line {}, {}", line, info.name)));
}

}  // namespace

PostureSet parse_postures_csv(std::string_view text, const std::string& set_name, const std::string& where) {
  if (!is_name(set_name)) throw Error(where, "file name", quoted_excerpt(set_name), kNameExpected);

  Lines lines(text);
  expect_headings(cells_of(*lines.next(), ','), where);
  PostureSet set{.name = set_name, .posture_names = {}, .postures = {}};
  std::set<std::string> names;
  while (const auto row = next_row(lines, kAngleCount + 1, where)) {
    const auto& [cells, line] = *row;
    if (!is_name(cells[0])) throw Error(where, line + ", name", quoted_excerpt(cells[0]), kNameExpected);
    set.posture_names.emplace_back(cells[0]);
    expect_new_name(set.posture_names.back(), names, where, line + ", name");
    Posture& posture = set.postures.emplace_back();
    for (int a = 0; a < kAngleCount; ++a)
      posture[a] = angle_from(cells[a + 1], angle_infos()[a], where, lines.number());
  }
  if (set.postures.empty()) throw Error(where, "postures", "none", "at least one line below the headings");
  return set;
}

Format posture_table_format() {
  return {.name = "posture_table",
          .ending = ".csv",
          .description = "a posture a line: name and 22 angles in degrees (README.md)",
          .postures = parse_postures_csv};
}

}  // namespace glovebench::trajectories
