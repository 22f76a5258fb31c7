#include <fmt/format.h>

#include <algorithm>

#include "core/base/json_cursor.h"
#include "core/base/math.h"
#include "core/base/parse_json.h"
#include "eval/estimates/estimate_format.h"
#include "trajectories/text_cells.h"

namespace glovebench::eval {
namespace {

void add_numbers(const JsonCursor& list, size_t count, double most, double factor, std::vector<double>& numbers) {
  const JsonItems items = list.items(count);
  for (size_t i = 0; i < count; ++i) numbers.push_back(factor * items[i].number(-most, most));
}

void add_line(const JsonCursor& line, const std::string& where, const std::string& field,
              EstimateSequence& sequence) {
  line.expect_keys(
      {"timestamp_us", "status"},
      {"frame", "cloud_points", "matching_error_px", "angles_deg", "position_mm", "quaternion_wxyz",
       "icp_iterations", "icp_residual_mm", "ambiguous", "converged", "angle_deviations_deg", "hidden"});
  const auto status = line["status"].one_of<TrackStatus>();
  std::vector<double> numbers;
  if (status == TrackStatus::tracked) {
    add_numbers(line["angles_deg"], kAngleCount, 360, radians_from_degrees(1), numbers);
    add_numbers(line["position_mm"], 3, 1e6, 0.001, numbers);
    add_numbers(line["quaternion_wxyz"], 4, 2, 1, numbers);
  }
  constexpr int64_t kLongest_us = 10'000'000'000'000'000;
  sequence.add(line["timestamp_us"].integer(-kLongest_us, kLongest_us), status, numbers, where, field);
}

/// JSON Lines as of core/tracker/track_result.h.
std::vector<EstimateSequence> read_track(std::string_view bytes, const EstimateFlags&, const std::string& where) {
  std::vector<EstimateSequence> sequences(1);
  sequences.front().reserve(static_cast<size_t>(std::ranges::count(bytes, '\n')));
  trajectories::Lines lines(bytes);
  while (const auto text = lines.next()) {
    if (text->empty()) continue;
    const std::string field = fmt::format("line {}", lines.number());
    const std::string place = fmt::format("{}: {}", where, field);
    const nlohmann::json line = parse_json(*text, place);
    add_line(JsonCursor(line, place), where, field, sequences.front());
  }
  return sequences;
}

}  // namespace

EstimateFormat track_estimates() {
  return {.name = "track",
          .description = "JSON Lines of `glovebench track`",
          .fits = [](std::string_view path, std::string_view) { return path.ends_with(".jsonl"); },
          .read = read_track};
}

}  // namespace glovebench::eval
