#include "trajectories/capture/marker_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/text.h"
#include "trajectories/text_cells.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {
namespace {

constexpr double kOwnShare = 0.5;  ///< of the distance that counts for a marker's own point

/// True if every point lies near its marker and no unlabeled point could be a marker that has none.
bool is_plausible(const std::vector<Eigen::Vector3d>& predicted, const std::vector<Eigen::Vector3d>& labeled,
                  bool some_unlabeled) {
  for (size_t m = 0; m < labeled.size(); ++m) {
    if (!is_seen(labeled[m])) {
      if (some_unlabeled) return false;
    } else if ((labeled[m] - predicted[m]).norm() > kOwnShare * kLabelGate) {
      return false;
    }
  }
  return true;
}

}  // namespace

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
    const std::optional<double> number = number_in<double>(cell);
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
  if (std::ranges::find(sequence.names, name) != sequence.names.end())
    throw Error(where, field, quoted_excerpt(name) + " again", "names that differ");
  if (sequence.names.size() == kMaxMarkers)
    throw Error(where, field, "more points", fmt::format("{} at most", kMaxMarkers));
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

std::vector<int> assign(const Eigen::MatrixXd& cost) {
  const int rows = static_cast<int>(cost.rows()), columns = static_cast<int>(cost.cols());
  check(rows <= columns, "an assignment needs a column for each row");
  // Row and column 0 are none; `row_of` is the row that has a column.
  std::vector<double> row_price(static_cast<size_t>(rows) + 1), column_price(static_cast<size_t>(columns) + 1);
  std::vector<size_t> row_of(static_cast<size_t>(columns) + 1), way(static_cast<size_t>(columns) + 1);
  for (int r = 1; r <= rows; ++r) {
    row_of[0] = static_cast<size_t>(r);
    size_t column = 0;
    std::vector<double> least(row_of.size(), std::numeric_limits<double>::infinity());
    std::vector<bool> used(row_of.size());
    do {  // the shortest path that frees a column
      used[column] = true;
      const size_t row = row_of[column];
      double delta = std::numeric_limits<double>::infinity();
      size_t next = 0;
      for (size_t c = 1; c < row_of.size(); ++c) {
        if (used[c]) continue;
        const double reduced =
            cost(static_cast<int>(row) - 1, static_cast<int>(c) - 1) - row_price[row] - column_price[c];
        if (reduced < least[c]) least[c] = reduced, way[c] = column;
        if (least[c] < delta) delta = least[c], next = c;
      }
      for (size_t c = 0; c < row_of.size(); ++c) {
        if (used[c]) {
          row_price[row_of[c]] += delta;
          column_price[c] -= delta;
        } else {
          least[c] -= delta;
        }
      }
      column = next;
    } while (row_of[column] != 0);
    for (; column != 0; column = way[column]) row_of[column] = row_of[way[column]];
  }
  std::vector<int> column_of(static_cast<size_t>(rows), -1);
  for (size_t c = 1; c < row_of.size(); ++c)
    if (row_of[c] > 0) column_of[row_of[c] - 1] = static_cast<int>(c) - 1;
  return column_of;
}

Relabeling relabel(const std::vector<Eigen::Vector3d>& predicted, const std::vector<Eigen::Vector3d>& labeled,
                   const std::vector<Eigen::Vector3d>& unlabeled) {
  check(predicted.size() == labeled.size(), "a frame has a point or a gap for each marker");
  std::vector<Eigen::Vector3d> candidates = labeled;
  std::ranges::copy_if(unlabeled, std::back_inserter(candidates), is_seen);
  if (is_plausible(predicted, labeled, candidates.size() > labeled.size())) return {labeled, 0};

  const size_t markers = predicted.size();
  const double none = kLabelGate * kLabelGate;
  // After the candidates, each marker has a column for no point.
  Eigen::MatrixXd cost =
      Eigen::MatrixXd::Constant(static_cast<int>(markers), static_cast<int>(candidates.size() + markers), none);
  for (size_t m = 0; m < markers; ++m) {
    for (size_t c = 0; c < candidates.size(); ++c) {
      const double distance = is_seen(candidates[c]) ? (candidates[c] - predicted[m]).norm() : 2 * kLabelGate;
      const double counted = c == m ? kOwnShare * distance : distance;
      // A point beyond the gate costs more than no point.
      cost(static_cast<int>(m), static_cast<int>(c)) = distance < kLabelGate ? counted * counted : 2 * none;
    }
  }
  const std::vector<int> column_of = assign(cost);
  Relabeling result;
  for (size_t m = 0; m < markers; ++m) {
    const auto c = static_cast<size_t>(column_of[m]);
    result.points.push_back(c < candidates.size() ? candidates[c] : gap());
    const bool had_point = is_seen(labeled[m]), has_point = c < candidates.size();
    if (had_point != has_point || (has_point && c != m)) ++result.corrected;
  }
  return result;
}

}  // namespace glovebench::trajectories
