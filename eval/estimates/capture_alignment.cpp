#include "eval/estimates/capture_alignment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/pose/horn.h"
#include "trajectories/trajectory_properties.h"

namespace glovebench::eval {
namespace {

constexpr size_t kLeastAnswers = 10;
constexpr size_t kMostAnswers = 1000;  // spread over the recording
constexpr double kLongestGap_us = 100'000;

/// Points of a tracked answer.
struct Answer {
  double time_us;
  Points points;
};

/// Answers, and the points of the capture to align them with.
struct Alignable {
  std::span<const HandFrame> capture;
  std::vector<Points> capture_points;
  std::vector<Answer> answers;
};

using AnswerRows = std::vector<Eigen::Index>;

struct RigidFit {
  Eigen::Isometry3d T_camera_capture = Eigen::Isometry3d::Identity();
  double mean_square = 0;         ///< m^2
  std::vector<double> distances;  ///< of the rows in the capture: root mean square, m
  AnswerRows rows;                ///< of `distances`
};

/// Index of the first capture frame after the time. Empty outside the capture and in a gap.
std::optional<size_t> frame_after(std::span<const HandFrame> capture, double time_us) {
  const auto after = std::ranges::upper_bound(
      capture, time_us, {}, [](const HandFrame& frame) { return static_cast<double>(frame.timestamp_us); });
  if (after == capture.begin() || after == capture.end()) return {};
  if (static_cast<double>(after->timestamp_us - (after - 1)->timestamp_us) > kLongestGap_us) return {};
  return static_cast<size_t>(after - capture.begin());
}

double share_between(const HandFrame& before, const HandFrame& after, double time_us) {
  const auto begin = static_cast<double>(before.timestamp_us), end = static_cast<double>(after.timestamp_us);
  return (time_us - begin) / (end - begin);
}

std::optional<Points> points_at(const Alignable& all, double time_us) {
  const std::optional<size_t> after = frame_after(all.capture, time_us);
  if (!after) return {};
  const double share = share_between(all.capture[*after - 1], all.capture[*after], time_us);
  return Points((1 - share) * all.capture_points[*after - 1] + share * all.capture_points[*after]);
}

/// Empty if fewer than half of the rows lie in the capture.
std::optional<RigidFit> fit_at(const Alignable& all, double offset_us, const AnswerRows& rows) {
  RigidFit fit;
  std::vector<Points> captured;
  std::vector<Eigen::Vector3f> from, to;
  for (const Eigen::Index r : rows) {
    const Answer& answer = all.answers[static_cast<size_t>(r)];
    std::optional<Points> points = points_at(all, answer.time_us + offset_us);
    if (!points) continue;
    for (Eigen::Index p = 0; p < points->cols(); ++p) {
      from.push_back(points->col(p).cast<float>());
      to.push_back(answer.points.col(p).cast<float>());
    }
    captured.push_back(*std::move(points));
    fit.rows.push_back(r);
  }
  if (2 * fit.rows.size() < rows.size()) return {};
  const std::optional<Eigen::Isometry3d> T = align_points(from, to);
  if (!T) return {};
  fit.T_camera_capture = *T;
  for (size_t i = 0; i < fit.rows.size(); ++i) {
    const Points& own = all.answers[static_cast<size_t>(fit.rows[i])].points;
    const Points moved = (T->linear() * captured[i]).colwise() + T->translation();
    const double square = (moved - own).colwise().squaredNorm().mean();
    fit.distances.push_back(std::sqrt(square));
    fit.mean_square += square / static_cast<double>(fit.rows.size());
  }
  return fit;
}

double median_step_us(const std::vector<Answer>& answers) {
  std::vector<double> steps;
  for (size_t i = 1; i < answers.size(); ++i) steps.push_back(answers[i].time_us - answers[i - 1].time_us);
  return quantile_of(steps, 0.5).value();
}

/// Mean square distance of some rows after their best transform, m^2; infinite if there is none.
double mean_square_at(const Alignable& all, double offset_us, const AnswerRows& rows) {
  const std::optional<RigidFit> fit = fit_at(all, offset_us, rows);
  return fit ? fit->mean_square : std::numeric_limits<double>::infinity();
}

/// The best of all offsets, in steps of half a frame. Empty if it has no neighbors, which may fit better.
std::optional<double> coarse_offset(const Alignable& all, const AnswerRows& rows, double step_us) {
  constexpr size_t kMostRows = 200;
  AnswerRows few;
  for (size_t i = 0; i < rows.size(); i += rows.size() / kMostRows + 1) few.push_back(rows[i]);
  const double middle = all.answers[static_cast<size_t>(few[few.size() / 2])].time_us,
               first = static_cast<double>(all.capture.front().timestamp_us) - middle,
               last = static_cast<double>(all.capture.back().timestamp_us) - middle;
  std::vector<double> squares;
  for (double offset = first; offset <= last; offset += step_us)
    squares.push_back(mean_square_at(all, offset, few));
  const auto best = static_cast<size_t>(std::ranges::min_element(squares) - squares.begin());
  const auto is_fitted = [&](size_t i) { return i < squares.size() && std::isfinite(squares[i]); };
  if (best == 0 || !is_fitted(best - 1) || !is_fitted(best) || !is_fitted(best + 1)) return {};
  return first + step_us * static_cast<double>(best);
}

/// Improves an offset by parabolas through three fits, ever closer. Empty if the fits do not differ.
std::optional<double> fine_offset(const Alignable& all, const AnswerRows& rows, double offset_us, double step_us) {
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round, step_us /= 3) {
    const double before = mean_square_at(all, offset_us - step_us, rows),
                 here = mean_square_at(all, offset_us, rows),
                 after = mean_square_at(all, offset_us + step_us, rows);
    const double bend = before - 2 * here + after;
    if (!std::isfinite(bend) || bend <= 0) return {};
    offset_us += step_us * std::clamp(0.5 * (before - after) / bend, -2.0, 2.0);
  }
  return offset_us;
}

/// Rows of the fit that are no farther off than three medians.
AnswerRows near_rows(const RigidFit& fit) {
  const double limit = 3 * quantile_of(fit.distances, 0.5).value();
  AnswerRows rows;
  for (size_t i = 0; i < fit.rows.size(); ++i)
    if (fit.distances[i] <= limit) rows.push_back(fit.rows[i]);
  return rows;
}

[[noreturn]] void refuse_alignment(const std::string& where) {
  throw Error(where, "alignment with the capture", "no time offset that fits best",
              "a recording and a capture of one hand that moves, at least half of the recording in the capture");
}

Alignable alignable(std::span<const HandFrame> capture, std::span<const TrackResult> answers,
                    const render::Subject& subject, const HandModel& hand, const std::string& where) {
  std::vector<const TrackResult*> tracked;
  for (const TrackResult& answer : answers)
    if (answer.status == TrackStatus::tracked) tracked.push_back(&answer);
  if (tracked.size() < kLeastAnswers)
    throw Error(where, "tracked frames", fmt::format("{}", tracked.size()),
                fmt::format("{} or more, to align them with the capture", kLeastAnswers));
  EstimateParts has = tracked.front()->has;
  PointComparison comparison{has, {}, &hand};
  comparison.has.posture = false;  // the palm alone, if there is a pose
  if (!has.pose)
    for (size_t j = 0; j < tracked.front()->joints.size(); ++j)
      if (tracked.front()->joints[j]) comparison.joints.push_back(static_cast<int>(j));
  if (!comparison.has_points() || !has.place || !has.scale)
    throw Error(where, "estimates", "neither poses nor joints in the camera's frame", "one of them");
  Alignable all{capture, points_of(comparison, capture, subject), {}};
  for (size_t i = 0; i < tracked.size(); i += tracked.size() / kMostAnswers + 1)
    all.answers.push_back({static_cast<double>(tracked[i]->timestamp_us), comparison.of(*tracked[i])});
  return all;
}

/// Intervals of an alignment from its rows, drawn anew in blocks of a second.
/// False if most draws have no best offset.
bool add_intervals(const Alignable& all, const AnswerRows& rows, double step_us, CaptureAlignment& alignment) {
  constexpr int kDraws = 200;
  constexpr double kSecond_us = 1e6;
  const double seconds = (all.answers.back().time_us - all.answers.front().time_us) / kSecond_us;
  const auto block = static_cast<Eigen::Index>(static_cast<double>(rows.size()) / std::max(seconds, 1.0));
  const Eigen::Isometry3d& T = alignment.T_camera_capture;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const HandFrame& frame : all.capture)
    center += frame.T_camera_hand.translation() / static_cast<double>(all.capture.size());
  std::vector<double> offsets, moves, turns;
  for (int draw = 0; draw < kDraws; ++draw) {
    AnswerRows drawn;
    for (const Eigen::Index i : drawn_rows(std::ssize(rows), std::max<Eigen::Index>(1, block), draw))
      drawn.push_back(rows[static_cast<size_t>(i)]);
    const auto offset = fine_offset(all, drawn, alignment.time.offset_us, step_us);
    const auto fit = offset ? fit_at(all, *offset, drawn) : std::nullopt;
    if (!fit) continue;
    offsets.push_back(*offset);
    moves.push_back((fit->T_camera_capture * center - T * center).norm());
    turns.push_back(angle_between(fit->T_camera_capture.linear(), T.linear()));
  }
  if (2 * offsets.size() < kDraws) return false;
  alignment.time.low_us = quantile_of(offsets, 0.025).value();
  alignment.time.high_us = quantile_of(offsets, 0.975).value();
  alignment.position_95 = quantile_of(moves, 0.95).value();
  alignment.rotation_95 = quantile_of(turns, 0.95).value();
  return true;
}

}  // namespace

CaptureAlignment align_to_capture(std::span<const HandFrame> capture, std::span<const TrackResult> answers,
                                  const render::Subject& subject, const HandModel& hand, const std::string& where) {
  const Alignable all = alignable(capture, answers, subject, hand, where);
  AnswerRows rows(all.answers.size());
  for (size_t r = 0; r < rows.size(); ++r) rows[r] = static_cast<Eigen::Index>(r);
  const double step_us = median_step_us(all.answers) / 2;
  std::optional<double> offset = coarse_offset(all, rows, step_us);
  std::optional<RigidFit> fit;
  constexpr int kRounds = 3;  // each leaves out what the one before found far off
  for (int round = 0; round < kRounds && offset; ++round) {
    offset = fine_offset(all, rows, *offset, step_us);
    fit = offset ? fit_at(all, *offset, rows) : std::nullopt;
    if (!fit) refuse_alignment(where);
    if (round + 1 < kRounds) rows = near_rows(*fit);
  }
  if (!fit) refuse_alignment(where);
  CaptureAlignment alignment{{*offset}, fit->T_camera_capture};
  alignment.residual = std::sqrt(fit->mean_square);
  alignment.used = rows.size();
  alignment.left_out = all.answers.size() - rows.size();
  if (!add_intervals(all, rows, step_us, alignment)) refuse_alignment(where);
  return alignment;
}

CapturedTruth captured_truth(std::span<const HandFrame> capture, std::span<const TrackResult> answers,
                             const CaptureAlignment& alignment, const std::string& where) {
  CapturedTruth truth;
  std::optional<int64_t> first_us;
  for (const TrackResult& answer : answers) {
    const double time_us = static_cast<double>(answer.timestamp_us) + alignment.time.offset_us;
    const std::optional<size_t> after = frame_after(capture, time_us);
    if (!after) continue;
    HandFrame& frame = truth.frames.emplace_back(trajectories::frame_between(
        capture[*after - 1], capture[*after], share_between(capture[*after - 1], capture[*after], time_us)));
    frame.T_camera_hand = alignment.T_camera_capture * frame.T_camera_hand;
    if (!first_us) first_us = answer.timestamp_us;
    frame.timestamp_us = answer.timestamp_us - *first_us;
    truth.answers.push_back(answer);
    truth.answers.back().timestamp_us = frame.timestamp_us;
  }
  if (truth.frames.empty()) throw Error(where, "frames", "none within the capture", "at least one");
  return truth;
}

}  // namespace glovebench::eval
