#include "trajectories/capture/marker_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text.h"
#include "trajectories/text_cells.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {

bool is_unlabeled(const std::string& name) {
  std::string lower = name;
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower.starts_with("unlabeled") || lower.starts_with("unnamed") || lower.starts_with("*");
}

int64_t timestamp_from(std::string_view cell, const std::string& where, const std::string& field) {
  constexpr double max_s = static_cast<double>(kMaxTimestampUs) / 1e6;
  return std::llround(1e6 * number_from(cell, -max_s, max_s, where, field));
}

Eigen::Vector3d point_from(std::span<const std::string_view> cells, double scale, const std::string& where,
                           const std::string& field) {
  const auto is_gap = [](std::string_view cell) {
    const std::optional<double> number = number_in(cell);
    return cell.empty() || (number && std::isnan(*number));
  };
  const auto gaps = std::ranges::count_if(cells, is_gap);
  if (gaps == 3) return gap();
  if (gaps > 0) throw Error(where, field, "a part of a point", "three numbers, or three empty cells");
  Eigen::Vector3d point;
  for (size_t i = 0; i < 3; ++i) {
    point[static_cast<int>(i)] =
        scale * number_from(cells[i], -kMaxCoordinate / scale, kMaxCoordinate / scale, where, field);
  }
  return point;
}

void add_name(std::string_view name, MarkerSequence& sequence, const std::string& where, const std::string& field) {
  const bool is_starred = name.starts_with("*") && is_name(name.substr(1));
  if (!is_name(name) && !is_starred) throw Error(where, field, quoted_excerpt(name), kNameExpected);
  if (std::ranges::find(sequence.names, name) != sequence.names.end()) {
    throw Error(where, field, quoted_excerpt(name) + " again", "names that differ");
  }
  if (sequence.names.size() == kMaxMarkers) {
    throw Error(where, field, "more points", fmt::format("{} at most", kMaxMarkers));
  }
  sequence.names.emplace_back(name);
}

void add_frame(MarkerFrame frame, int64_t first_us, size_t text_bytes, MarkerSequence& sequence,
               const std::string& where, const std::string& field) {
  frame.timestamp_us -= first_us;
  if (!sequence.frames.empty() && frame.timestamp_us <= sequence.frames.back().timestamp_us) {
    throw Error(where, field, fmt::format("{} s", static_cast<double>(frame.timestamp_us + first_us) / 1e6),
                "a time after that of the frame before");
  }
  if (sequence.frames.size() == kMaxMarkerFrames)
    throw Error(where, field, "more frames", fmt::format("{} at most, an hour at 120 Hz", kMaxMarkerFrames));
  constexpr size_t any = 300'000, bytes_of_a_point = 3;  // the commas between its cells
  if ((sequence.frames.size() + 1) * frame.points.size() > any + text_bytes / bytes_of_a_point) {
    throw Error(where, field, fmt::format("most points of {} frames left out", sequence.frames.size() + 1),
                "more points, or fewer frames");
  }
  sequence.frames.push_back(std::move(frame));
}

}  // namespace glovebench::trajectories
