#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/error.h"
#include "eval/estimates/estimate_format.h"
#include "trajectories/text_cells.h"

namespace glovebench::eval {
namespace {

/// Poses of the hand frame in the camera frame: time (s), x y z (m), quaternion x y z w, with blanks between them.
std::vector<EstimateSequence> read_tum(std::string_view bytes, const EstimateFlags& flags,
                                       const std::string& where) {
  constexpr double kLargest = 1e9;
  std::vector<EstimateSequence> sequences(1);
  EstimateSequence& sequence = sequences.front();
  sequence.has.posture = false;
  const double unit = meters_of(flags.units.empty() ? "m" : "", flags.units, where, "unit"),
               unit_us = microseconds_of(flags.time.empty() ? "s" : "", flags.time, where, "time");
  if (flags.units == "none") throw Error(where, "--units", "none", "a unit, since poses have positions");
  sequence.reserve(static_cast<size_t>(std::ranges::count(bytes, '\n')));
  trajectories::Lines lines(bytes);
  while (const auto line = lines.next()) {
    std::vector<std::string_view> cells;
    for (const std::string_view cell : trajectories::cells_of(*line, ' '))
      if (!cell.empty()) cells.push_back(cell);
    if (cells.empty() || cells.front().starts_with('#')) continue;
    const std::string field = fmt::format("line {}", lines.number());
    if (cells.size() != 8)
      throw Error(where, field, fmt::format("{} numbers", cells.size()), "time, x y z, quaternion x y z w");
    std::array<double, 8> n;
    for (size_t i = 0; i < n.size(); ++i)
      n[i] = trajectories::number_from(cells[i], -10 * kLargest, 10 * kLargest, where, field);
    const std::array own = {unit * n[1], unit * n[2], unit * n[3], n[7], n[4], n[5], n[6]};
    sequence.add(timestamp_of(n[0], unit_us, where, field), TrackStatus::tracked, own, where, field);
  }
  return sequences;
}

}  // namespace

EstimateFormat tum_estimates() {
  return {.name = "tum",
          .description = "poses: time (s), x y z (m), quaternion x y z w",
          .fits = [](std::string_view path,
                     std::string_view) { return path.ends_with(".tum") || path.ends_with(".txt"); },
          .read = read_tum};
}

}  // namespace glovebench::eval
