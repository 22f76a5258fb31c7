#include "eval/estimates/time_match.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"

namespace glovebench::eval {
namespace {

constexpr int64_t kReach_us = 1'000'000;
constexpr int kLeastEstimates = 10;

/// Index of the frame that is nearest in time.
size_t nearest(std::span<const HandFrame> truth, int64_t time_us) {
  const auto after = std::ranges::lower_bound(truth, time_us, {}, &HandFrame::timestamp_us);
  if (after == truth.begin()) return 0;
  if (after == truth.end()) return truth.size() - 1;
  const auto before = after - 1;
  const bool is_before = time_us - before->timestamp_us <= after->timestamp_us - time_us;
  return static_cast<size_t>((is_before ? before : after) - truth.begin());
}

/// Empty beyond the first and last frame.
std::optional<Points> truth_at(double time_us, std::span<const HandFrame> truth,
                               const std::vector<Points>& points) {
  if (time_us < static_cast<double>(truth.front().timestamp_us) ||
      time_us > static_cast<double>(truth.back().timestamp_us))
    return {};
  const auto after = std::ranges::lower_bound(
      truth, time_us, {}, [](const HandFrame& f) { return static_cast<double>(f.timestamp_us); });
  const auto i = static_cast<size_t>(after - truth.begin());
  if (i == 0) return points[0];
  const auto begin = static_cast<double>(truth[i - 1].timestamp_us),
             end = static_cast<double>(truth[i].timestamp_us);
  const double share = (time_us - begin) / (end - begin);
  return Points((1 - share) * points[i - 1] + share * points[i]);
}

/// Distances of estimates (rows) at offsets (columns); NaN where the truth ends.
struct OffsetDistances {
  double first_us = 0, step_us = 0;
  Eigen::ArrayXXd distances;
};

/// The offset with the least mean square of these rows, by a parabola. Empty if it is at an end.
std::optional<double> best_offset(const OffsetDistances& all, std::span<const Eigen::Index> rows) {
  std::vector<double> means;
  for (Eigen::Index c = 0; c < all.distances.cols(); ++c) {
    double sum = 0;
    size_t count = 0;
    for (const Eigen::Index r : rows)
      if (std::isfinite(all.distances(r, c))) sum += all.distances(r, c) * all.distances(r, c), ++count;
    // An offset that leaves few estimates on the truth could fit by chance.
    means.push_back(2 * count >= rows.size() ? sum / static_cast<double>(count) : std::nan(""));
  }
  const auto best = std::ranges::min_element(means, [](double a, double b) { return !std::isnan(a) && !(a >= b); });
  const auto c = static_cast<size_t>(best - means.begin());
  if (c == 0 || c + 1 >= means.size() || !std::isfinite(means[c - 1]) || !std::isfinite(means[c + 1])) return {};
  const double bend = means[c - 1] - 2 * means[c] + means[c + 1];
  const double shift = bend > 0 ? 0.5 * (means[c - 1] - means[c + 1]) / bend : 0;
  return all.first_us + all.step_us * (static_cast<double>(c) + shift);
}

OffsetDistances distances_by_offset(const PointComparison& comparison, std::span<const HandFrame> truth,
                                    const std::vector<Points>& true_points, const EstimateSequence& estimates) {
  constexpr int kStepsPerFrame = 4;
  const int64_t start = truth.front().timestamp_us, own_start = estimates.timestamps_us.front();
  const bool overlap =
      own_start <= truth.back().timestamp_us && estimates.timestamps_us.back() >= truth.front().timestamp_us;
  OffsetDistances all;
  all.step_us = std::max(1000.0, 2.0 * static_cast<double>(default_tolerance_us(truth)) / kStepsPerFrame);
  all.first_us =
      (overlap ? 0 : static_cast<double>(start - own_start)) - std::ceil(kReach_us / all.step_us) * all.step_us;
  constexpr size_t kMost = 2000;
  std::vector<size_t> tracked;
  for (size_t i = 0; i < estimates.size(); i += estimates.size() / kMost + 1)
    if (estimates.statuses[i] == TrackStatus::tracked) tracked.push_back(i);
  const auto columns = static_cast<Eigen::Index>(2 * std::ceil(kReach_us / all.step_us)) + 1;
  all.distances.setConstant(std::ssize(tracked), columns, std::nan(""));
  for (size_t r = 0; r < tracked.size(); ++r) {
    const Points own = comparison.of(estimates.answer(tracked[r]));
    const auto time = static_cast<double>(estimates.timestamps_us[tracked[r]]);
    for (Eigen::Index c = 0; c < columns; ++c)
      if (const auto at = truth_at(time + all.first_us + all.step_us * static_cast<double>(c), truth, true_points))
        all.distances(static_cast<Eigen::Index>(r), c) = comparison.distance(own, *at);
  }
  return all;
}

}  // namespace

std::vector<Eigen::Index> drawn_rows(Eigen::Index count, Eigen::Index block, int draw) {
  RandomStream random(1, "time offset", draw, "bootstrap");
  std::vector<Eigen::Index> rows;
  const Eigen::Index blocks = std::max<Eigen::Index>(1, count / block);
  for (Eigen::Index b = 0; b < blocks; ++b) {
    const auto chosen = static_cast<Eigen::Index>(random.index(static_cast<uint64_t>(blocks)));
    for (Eigen::Index r = count * chosen / blocks; r < count * (chosen + 1) / blocks; ++r) rows.push_back(r);
  }
  return rows;
}

int64_t default_tolerance_us(std::span<const HandFrame> truth) {
  std::vector<int64_t> steps;
  for (size_t i = 1; i < truth.size(); ++i) steps.push_back(truth[i].timestamp_us - truth[i - 1].timestamp_us);
  if (steps.empty()) return 0;
  std::ranges::nth_element(steps, steps.begin() + std::ssize(steps) / 2);
  return steps[steps.size() / 2] / 2;
}

TimeMatch match_times(std::span<const HandFrame> truth, const EstimateSequence& estimates, int64_t offset_us,
                      int64_t tolerance_us, const std::string& where) {
  std::vector<std::optional<size_t>> chosen(truth.size());
  const auto distance = [&](size_t frame, size_t estimate) {
    return std::abs(estimates.timestamps_us[estimate] + offset_us - truth[frame].timestamp_us);
  };
  for (size_t e = 0; e < estimates.size(); ++e) {
    const size_t frame = nearest(truth, estimates.timestamps_us[e] + offset_us);
    if (distance(frame, e) > tolerance_us) continue;
    if (!chosen[frame] || distance(frame, e) < distance(frame, *chosen[frame])) chosen[frame] = e;
  }
  TimeMatch match;
  for (size_t f = 0; f < truth.size(); ++f) {
    TrackResult& answer = match.answers.emplace_back();
    answer.has = estimates.has;
    answer.status = TrackStatus::missing;
    if (chosen[f]) answer = estimates.answer(*chosen[f]);
    match.missing += !chosen[f];
    if (chosen[f] && distance(f, *chosen[f]) > 0) match.is_exact = false;
    answer.timestamp_us = truth[f].timestamp_us;
  }
  const auto frames = static_cast<int>(truth.size());
  match.unmatched = static_cast<int>(estimates.size()) - (frames - match.missing);
  if (match.missing < frames) return match;
  const auto ms = [](int64_t us) { return fmt::format("{:.1f}", static_cast<double>(us) / 1000); };
  throw Error(where, "time stamps",
              fmt::format("{} to {} ms", ms(estimates.timestamps_us.front() + offset_us),
                          ms(estimates.timestamps_us.back() + offset_us)),
              fmt::format("some within {} ms of the truth's {} to {} ms (see --time-offset, --time-unit)",
                          ms(tolerance_us), ms(truth.front().timestamp_us), ms(truth.back().timestamp_us)));
}

TimeOffset estimate_offset(const PointComparison& comparison, std::span<const HandFrame> truth,
                           const std::vector<Points>& true_points, const EstimateSequence& estimates,
                           const std::string& where) {
  const OffsetDistances all = distances_by_offset(comparison, truth, true_points, estimates);
  const Eigen::Index count = all.distances.rows();
  if (count < kLeastEstimates)
    throw Error(where, "tracked estimates", fmt::format("{}", count),
                fmt::format("{} or more, to estimate the time offset", kLeastEstimates));
  const double seconds =
      static_cast<double>(estimates.timestamps_us.back() - estimates.timestamps_us.front()) / kReach_us;
  const auto block =
      std::max<Eigen::Index>(1, static_cast<Eigen::Index>(static_cast<double>(count) / std::max(seconds, 1.0)));
  constexpr int kDraws = 500;
  std::vector<double> drawn;
  for (int draw = 0; draw < kDraws; ++draw)
    if (const auto offset = best_offset(all, drawn_rows(count, block, draw))) drawn.push_back(*offset);
  std::vector<Eigen::Index> rows(static_cast<size_t>(count));
  for (size_t r = 0; r < rows.size(); ++r) rows[r] = static_cast<Eigen::Index>(r);
  const std::optional<double> offset = best_offset(all, rows);
  if (!offset || 2 * drawn.size() < kDraws)
    throw Error(where, "time offset", "none within 1 s that fits best", "--time-offset in ms, or a moving hand");
  std::ranges::sort(drawn);
  const auto at = [&](double share) {
    return drawn[static_cast<size_t>(share * static_cast<double>(drawn.size() - 1))];
  };
  return {*offset, at(0.025), at(0.975)};
}

}  // namespace glovebench::eval
