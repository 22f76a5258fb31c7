#include "eval/estimates/estimate_doubts.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <functional>
#include <optional>

#include "core/base/math.h"

namespace glovebench::eval {
namespace {

using Change = std::function<TrackResult(TrackResult)>;

constexpr double kLeastGain_mm = 5, kLeastGain_deg = 3, kLeastMirrorGain_mm = 2;
constexpr int kMostFrames = 200;  // spread over the movement

/// A mistake that would explain the errors, with the mean distances as it is and without the mistake.
struct Doubt {
  std::string what;
  double before = 0, after = 0;
  double least_gain = 0;

  bool is_likely() const { return after < before / 2 && before - after > least_gain; }
};

/// What is compared. Frames are those that are tracked.
struct Evidence {
  const PointComparison& comparison;
  std::vector<TrackResult> answers;
  std::vector<Points> truths;
  double before = 0;  ///< mean distance

  double distance(const Change& change) const {
    double sum = 0;
    for (size_t i = 0; i < answers.size(); ++i)
      sum += comparison.distance(comparison.of(change(answers[i])), truths[i]);
    return sum / static_cast<double>(answers.size());
  }
  Doubt doubt(std::string what, const Change& change, double least_gain = kLeastGain_mm) const {
    return {std::move(what), before, distance(change), least_gain};
  }
};

/// The change of the pose's translation and of each joint.
template <typename Move>
TrackResult moved(TrackResult answer, const Move& move) {
  answer.T_camera_hand.translation() = move(Eigen::Vector3d(answer.T_camera_hand.translation()));
  for (auto& joint : answer.joints)
    if (joint) joint = move(*joint);
  return answer;
}

/// "x, -z, y" of a signed permutation.
std::string axes_text(const Eigen::Matrix3d& axes) {
  std::string text;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      if (axes(row, column) != 0)
        text += fmt::format("{}{}{}", row > 0 ? ", " : "", axes(row, column) < 0 ? "-" : "", "xyz"[column]);
  return text;
}

std::vector<Doubt> axis_doubts(const Evidence& evidence) {
  std::vector<Doubt> doubts;
  std::array<int, 3> order = {0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
      for (int row = 0; row < 3; ++row) axes(row, order[row]) = signs >> row & 1 ? -1 : 1;
      if (axes.isIdentity()) continue;
      // A pose in a mirrored world is that of a mirrored hand.
      const Eigen::Matrix3d own = Eigen::Vector3d(axes.determinant(), 1, 1).asDiagonal();
      const auto change = [&](TrackResult answer) {
        answer.T_camera_hand.linear() = axes * answer.T_camera_hand.linear() * own;
        return moved(std::move(answer), [&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return axes * p; });
      };
      doubts.push_back(
          evidence.doubt(fmt::format("the axes are swapped: x, y, z should be {}", axes_text(axes)), change));
    }
  } while (std::ranges::next_permutation(order).found);
  return doubts;
}

std::vector<Doubt> scale_doubts(const Evidence& evidence) {
  std::vector<Doubt> doubts;
  for (const auto& [factor, what] : {std::pair(1000.0, "1000 times too small, as meters read as millimeters"),
                                     {0.001, "1000 times too large, as millimeters read as meters"},
                                     {100.0, "100 times too small"},
                                     {0.01, "100 times too large"},
                                     {10.0, "10 times too small"},
                                     {0.1, "10 times too large"}}) {
    doubts.push_back(evidence.doubt(fmt::format("positions are {}", what), [&, by = factor](TrackResult answer) {
      return moved(std::move(answer), [&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return by * p; });
    }));
  }
  return doubts;
}

std::vector<Doubt> quaternion_doubts(const Evidence& evidence) {
  const auto reordered = [](bool from_xyzw) {
    return [from_xyzw](TrackResult answer) {
      const Eigen::Quaterniond q(answer.T_camera_hand.linear());
      const Eigen::Quaterniond other = from_xyzw ? Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y())
                                                 : Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w());
      answer.T_camera_hand.linear() = other.toRotationMatrix();
      return answer;
    };
  };
  return {evidence.doubt("quaternions are in the order x, y, z, w", reordered(true)),
          evidence.doubt("quaternions are in the order w, x, y, z", reordered(false))};
}

std::vector<Doubt> order_doubts(const Evidence& evidence, const JointOrder& order) {
  std::vector<Doubt> doubts;
  const auto is_unknown = [](const NamedJoint& joint) { return joint.joint < 0; };
  for (const JointOrder& other : joint_orders()) {
    if (other.name == order.name || other.joints.size() != order.joints.size()) continue;
    if (std::ranges::any_of(order.joints, is_unknown) || std::ranges::any_of(other.joints, is_unknown)) continue;
    doubts.push_back(
        evidence.doubt(fmt::format("the joints are in the order of {}", other.name), [&](TrackResult answer) {
          const auto joints = answer.joints;
          for (size_t i = 0; i < order.joints.size(); ++i)
            answer.joints[other.joints[i].joint] = joints[order.joints[i].joint];
          return answer;
        }));
  }
  return doubts;
}

/// After the best similarity transform, with or without a reflection.
double aligned_distance(const Evidence& evidence, bool mirrored) {
  double sum = 0;
  for (size_t i = 0; i < evidence.answers.size(); ++i) {
    Eigen::Matrix3Xd points = evidence.comparison.of(evidence.answers[i]);
    const Eigen::Matrix3Xd truth = evidence.truths[i];
    if (mirrored) points.row(0) *= -1;
    const Eigen::Matrix4d T = Eigen::umeyama(points, truth, true);
    points = ((T.topLeftCorner<3, 3>() * points).colwise() + T.col(3).head<3>()).eval();
    sum += 1000 * (points - truth).colwise().norm().mean();
  }
  return sum / static_cast<double>(evidence.answers.size());
}

Doubt mirror_doubt(const Evidence& evidence) {
  return {"the hand is mirrored (aligned joints)", aligned_distance(evidence, false),
          aligned_distance(evidence, true), kLeastMirrorGain_mm};
}

Doubt offset_doubt(const Evidence& evidence) {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < evidence.answers.size(); ++i)
    offset += (evidence.truths[i] - evidence.comparison.of(evidence.answers[i])).rowwise().mean();
  offset /= static_cast<double>(evidence.answers.size());
  return evidence.doubt(fmt::format("all positions are off by ({:.0f}, {:.0f}, {:.0f}) mm", -1000 * offset.x(),
                                    -1000 * offset.y(), -1000 * offset.z()),
                        [&](TrackResult answer) {
                          return moved(std::move(answer),
                                       [&](const Eigen::Vector3d& p) -> Eigen::Vector3d { return p + offset; });
                        });
}

/// Compares each answer with the truth some frames earlier or later, on the frames that have both.
std::vector<Doubt> lag_doubts(const PointComparison& comparison, std::span<const HandFrame> truth,
                              std::span<const Points> true_points, std::span<const TrackResult> answers) {
  constexpr int kMostFrames = 15, kLeastPairs = 10;
  const int count = static_cast<int>(answers.size());
  const double step_ms = count < 2 ? 0
                                   : static_cast<double>(truth.back().timestamp_us - truth.front().timestamp_us) /
                                         (1000.0 * (count - 1));
  std::vector<Points> own(answers.size());
  for (int f = 0; f < count; ++f)
    if (answers[f].status == TrackStatus::tracked) own[f] = comparison.of(answers[f]);
  std::vector<Doubt> doubts;
  for (int lag = -kMostFrames; lag <= kMostFrames; ++lag) {
    Doubt doubt{fmt::format("estimates {} by {} frames ({:.0f} ms, see --time-offset)", lag > 0 ? "lag" : "lead",
                            std::abs(lag), std::abs(lag) * step_ms),
                0, 0, comparison.has_points() ? kLeastGain_mm : kLeastGain_deg};
    int pairs = 0;
    for (int f = std::max(0, lag); f < std::min(count, count + lag); ++f) {
      if (answers[f].status != TrackStatus::tracked) continue;
      doubt.before += comparison.distance(own[f], true_points[f]);
      doubt.after += comparison.distance(own[f], true_points[f - lag]);
      ++pairs;
    }
    if (lag == 0 || pairs < kLeastPairs) continue;
    doubt.before /= pairs;
    doubt.after /= pairs;
    doubts.push_back(std::move(doubt));
  }
  return doubts;
}

std::vector<Doubt> angle_unit_doubts(const PointComparison& comparison, std::span<const HandFrame> truth,
                                     std::span<const TrackResult> answers) {
  const auto mean_rms = [&](double factor) {
    double sum = 0;
    int count = 0;
    for (size_t f = 0; f < answers.size(); ++f) {
      if (answers[f].status != TrackStatus::tracked) continue;
      sum += degrees_from_radians(posture_distance(factor * answers[f].posture, truth[f].posture));
      ++count;
    }
    return sum / std::max(count, 1);
  };
  if (!comparison.has.posture) return {};
  const double degree = radians_from_degrees(1);
  return {{"angles are degrees read as radians", mean_rms(1), mean_rms(degree), kLeastGain_deg},
          {"angles are radians read as degrees", mean_rms(1), mean_rms(1 / degree), kLeastGain_deg}};
}

/// The first of the likely ones that fit about as well as the best, since the simplest come first.
std::optional<std::string> best_of(const std::vector<Doubt>& doubts, const char* unit) {
  const auto ratio = [](const Doubt& doubt) { return doubt.is_likely() ? doubt.after / doubt.before : 1; };
  double best = 1;
  for (const Doubt& doubt : doubts) best = std::min(best, ratio(doubt));
  for (const Doubt& doubt : doubts) {
    const bool is_about_best = ratio(doubt) <= 1.2 * best + 0.002;
    if (!doubt.is_likely() || !is_about_best) continue;
    return fmt::format("perhaps {}: the mean error would be {:.1f} {}, not {:.1f} {}", doubt.what, doubt.after,
                       unit, doubt.before, unit);
  }
  return {};
}

Evidence evidence_of(const PointComparison& comparison, std::span<const Points> true_points,
                     std::span<const TrackResult> answers) {
  Evidence evidence{comparison, {}, {}};
  const size_t stride = answers.size() / kMostFrames + 1;
  for (size_t f = 0; f < answers.size(); f += stride) {
    if (answers[f].status != TrackStatus::tracked) continue;
    evidence.answers.push_back(answers[f]);
    evidence.truths.push_back(true_points[f]);
  }
  if (!evidence.answers.empty()) evidence.before = evidence.distance([](TrackResult answer) { return answer; });
  return evidence;
}

}  // namespace

std::optional<std::string> estimate_doubt(const PointComparison& comparison, std::span<const HandFrame> truth,
                                          std::span<const Points> true_points, std::span<const TrackResult> answers,
                                          const JointOrder& order) {
  const Evidence evidence = evidence_of(comparison, true_points, answers);
  if (evidence.answers.empty()) return {};
  // Joints of wrong angles tell nothing.
  if (auto angles = best_of(angle_unit_doubts(comparison, truth, answers), "deg")) return angles;
  std::vector<Doubt> doubts;
  const auto add = [&](std::vector<Doubt> more) { std::ranges::move(more, std::back_inserter(doubts)); };
  if (comparison.has_points()) {
    add(axis_doubts(evidence));
    if (comparison.has.scale) add(scale_doubts(evidence));
    if (comparison.has.pose) add(quaternion_doubts(evidence));
    if (!comparison.joints.empty()) add(order_doubts(evidence, order));
    if (!comparison.joints.empty()) add({mirror_doubt(evidence)});
  }
  add(lag_doubts(comparison, truth, true_points, answers));
  if (comparison.has_points() && comparison.has.place && comparison.has.scale) add({offset_doubt(evidence)});
  return best_of(doubts, comparison.unit());
}

}  // namespace glovebench::eval
