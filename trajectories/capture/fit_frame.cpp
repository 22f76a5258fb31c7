#include "trajectories/capture/fit_frame.h"

#include <Eigen/Cholesky>

#include "core/base/error.h"
#include "trajectories/capture/marker_sequence.h"
#include "trajectories/generation/natural_variation.h"

namespace glovebench::trajectories {
namespace {

constexpr int kFirstAngle = kStateSize - kAngleCount;

double end_joint_excess(const Posture& posture, int pip) {
  return posture[pip + 1] - kEndJointShare * posture[pip];
}

using StateMatrix = Eigen::Matrix<double, kStateSize, kStateSize>;

constexpr double kLeastDamping = 1e-9, kFirstDamping = 1e-3, kMostDamping = 1e9;
constexpr double kSmallestGain = 1e-9;  ///< of the cost, relative: the end

struct Equations {
  StateMatrix H;
  StateStep b;
};

Equations equations(const CaptureHand& hand, const HandState& state, const WeightedResiduals& weighted,
                    const PosturePrior& prior) {
  const Eigen::MatrixXd J = weighted.row_scale.asDiagonal() * state_jacobian(hand, state);
  Equations e{J.transpose() * J, J.transpose() * weighted.residuals};
  add_prior(state.posture, prior, e.H, e.b);
  hold_at_limits(state, e.H, e.b);
  return e;
}

/// A little on the diagonal: a frame of one point has a pose, too.
StateStep solve(const Equations& e, double damping) {
  StateMatrix H = e.H;
  H.diagonal().array() *= 1 + damping;
  H.diagonal().array() += 1e-6;
  return H.ldlt().solve(e.b);
}

/// A place between two frames that show a value. If both are the same, the value is constant.
struct Between {
  size_t before;
  size_t after;
  double share;  ///< of the way from one to the other
};

/// For each frame that does not show a value, the frames around it that do. Empty if none does.
template <typename Shown>
std::vector<std::pair<size_t, Between>> gaps_of(size_t count, const std::vector<double>& times_s, Shown is_shown) {
  std::vector<std::pair<size_t, Between>> gaps;
  std::vector<size_t> shown;
  for (size_t f = 0; f < count; ++f)
    if (is_shown(f)) shown.push_back(f);
  if (shown.empty()) return gaps;
  size_t next = 0;
  for (size_t f = 0; f < count; ++f) {
    while (next < shown.size() && shown[next] < f) ++next;
    if (next < shown.size() && shown[next] == f) continue;
    const size_t after = next < shown.size() ? shown[next] : shown.back();
    const size_t before = next > 0 ? shown[next - 1] : shown.front();
    const double span = times_s[after] - times_s[before];
    gaps.emplace_back(f, Between{before, after, span > 0 ? (times_s[f] - times_s[before]) / span : 0});
  }
  return gaps;
}

Eigen::Isometry3d between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double share) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const Eigen::Quaterniond from(a.linear()), to(b.linear());
  T.linear() = from.slerp(share, to).normalized().toRotationMatrix();
  T.translation() = (1 - share) * a.translation() + share * b.translation();
  return T;
}

bool is_end_joint(int angle) { return angle >= kIndexDipFlexion && (angle - kIndexDipFlexion) % 4 == 0; }

void bridge_angle(int a, const std::vector<Observability>& shown, const std::vector<double>& times_s,
                  Bridged& result) {
  const auto index = static_cast<size_t>(a);
  // Without a pose, no angle is shown.
  const auto is_shown = [&](size_t f) { return shown[f].pose && shown[f].angles[index]; };
  const std::vector<HandState> states = result.states;
  size_t last = states.size();
  for (const auto& [f, gap] : gaps_of(states.size(), times_s, is_shown)) {
    result.states[f].posture[a] =
        (1 - gap.share) * states[gap.before].posture[a] + gap.share * states[gap.after].posture[a];
    result.angles[f][index] = true;
    if (f != last + 1) ++result.angle_gaps;
    last = f;
  }
  bool ever = false;
  for (size_t f = 0; f < states.size(); ++f) ever |= is_shown(f);
  if (ever) return;
  result.never_shown[index] = true;
  for (size_t f = 0; f < states.size(); ++f) {
    result.states[f].posture[a] = is_end_joint(a) ? kEndJointShare * result.states[f].posture[a - 1] : 0.0;
    result.angles[f][index] = true;
  }
}

}  // namespace

double prior_cost(const Posture& posture, const PosturePrior& prior) {
  double cost = (posture - prior.center).squaredNorm() / (prior.deviation * prior.deviation);
  for (int pip = kIndexPipFlexion; pip < kAngleCount; pip += 4) {
    const double excess = end_joint_excess(posture, pip) / prior.end_joint_deviation;
    cost += excess * excess;
  }
  return cost;
}

void add_prior(const Posture& posture, const PosturePrior& prior, Eigen::Ref<Eigen::MatrixXd> H,
               Eigen::Ref<Eigen::VectorXd> b) {
  const double weight = 1 / (prior.deviation * prior.deviation);
  H.diagonal().tail<kAngleCount>().array() += weight;
  b.tail<kAngleCount>() += weight * (prior.center - posture);
  const double joined = 1 / (prior.end_joint_deviation * prior.end_joint_deviation);
  const Eigen::Vector2d row(-kEndJointShare, 1);
  for (int pip = kIndexPipFlexion; pip < kAngleCount; pip += 4) {
    const int at = kFirstAngle + pip;
    H.block<2, 2>(at, at) += joined * row * row.transpose();
    b.segment<2>(at) -= joined * end_joint_excess(posture, pip) * row;
  }
}

WeightedResiduals weighted_residuals(const CaptureHand& hand, const std::vector<Eigen::Vector3d>& points,
                                     const HandState& state, double robust_scale) {
  check(points.size() == hand.markers.size(), "a frame has a point or a gap for each marker");
  const std::vector<Eigen::Vector3d> predicted = predict_points(hand, state);
  const auto rows = static_cast<Eigen::Index>(3 * points.size());
  WeightedResiduals result{Eigen::VectorXd::Zero(rows), Eigen::VectorXd::Zero(rows)};
  const double scale = robust_scale / kPointDeviation;
  for (size_t m = 0; m < points.size(); ++m) {
    if (!is_seen(points[m])) continue;
    const Eigen::Vector3d r = (points[m] - predicted[m]) / kPointDeviation;
    const double relative = r.squaredNorm() / (scale * scale);
    const double root_weight = 1 / std::sqrt(1 + relative);
    result.residuals.segment<3>(static_cast<Eigen::Index>(3 * m)) = root_weight * r;
    result.row_scale.segment<3>(static_cast<Eigen::Index>(3 * m)).setConstant(root_weight / kPointDeviation);
    result.cost += scale * scale * std::log1p(relative);
  }
  return result;
}

void hold_at_limits(const HandState& state, Eigen::Ref<Eigen::MatrixXd> H, Eigen::Ref<Eigen::VectorXd> b) {
  for (int a = 0; a < kAngleCount; ++a) {
    const AngleInfo& info = angle_infos()[static_cast<size_t>(a)];
    const bool at_min = state.posture[a] <= radians_from_degrees(info.min_deg) && b[6 + a] < 0;
    const bool at_max = state.posture[a] >= radians_from_degrees(info.max_deg) && b[6 + a] > 0;
    if (!at_min && !at_max) continue;
    H.row(6 + a).setZero();
    H.col(6 + a).setZero();
    H(6 + a, 6 + a) = 1;
    b[6 + a] = 0;
  }
}

FrameFit fit_frame(const CaptureHand& hand, const std::vector<Eigen::Vector3d>& points, const HandState& start,
                   const FrameFitOptions& options) {
  HandState state = start;
  state.posture = clamp_to_limits(start.posture);
  WeightedResiduals weighted = weighted_residuals(hand, points, state, options.robust_scale);
  const PosturePrior prior{.center = start.posture};
  double cost = weighted.cost + prior_cost(state.posture, prior);
  double damping = kFirstDamping;
  for (int i = 0; i < options.max_iterations && damping < kMostDamping; ++i) {
    const Equations e = equations(hand, state, weighted, prior);
    bool better = false;
    double gain = 0;
    while (!better && damping < kMostDamping) {
      const HandState next = moved(state, solve(e, damping));
      WeightedResiduals next_weighted = weighted_residuals(hand, points, next, options.robust_scale);
      const double next_cost = next_weighted.cost + prior_cost(next.posture, prior);
      better = next_cost < cost;
      damping = better ? std::max(kLeastDamping, damping / 10) : damping * 10;
      if (!better) continue;
      gain = cost - next_cost;
      state = next;
      weighted = std::move(next_weighted);
      cost = next_cost;
    }
    if (gain <= kSmallestGain * cost) break;
  }
  return {state, cost};
}

std::vector<double> point_distances(const CaptureHand& hand, const std::vector<Eigen::Vector3d>& points,
                                    const HandState& state) {
  const std::vector<Eigen::Vector3d> predicted = predict_points(hand, state);
  std::vector<double> distances;
  for (size_t m = 0; m < points.size(); ++m) distances.push_back((points[m] - predicted[m]).norm());
  return distances;
}

Observability observability(const CaptureHand& hand, const std::vector<Eigen::Vector3d>& points,
                            const HandState& state, double robust_scale) {
  const WeightedResiduals weighted = weighted_residuals(hand, points, state, robust_scale);
  const Eigen::MatrixXd J = weighted.row_scale.asDiagonal() * state_jacobian(hand, state);
  StateMatrix H = J.transpose() * J;
  // As weak as it may be and still make what no point shows invertible.
  constexpr double weak_turn = radians_from_degrees(1000), weak_shift = 10;
  H.diagonal().array() += 1 / (weak_turn * weak_turn);
  H.diagonal().segment<3>(3).array() += 1 / (weak_shift * weak_shift);
  const StateStep deviation = H.ldlt().solve(StateMatrix::Identity()).diagonal().cwiseSqrt();
  Observability shown;
  constexpr double shown_shift = 0.01;
  shown.pose = deviation.head<3>().maxCoeff() < kShownDeviation && deviation.segment<3>(3).maxCoeff() < shown_shift;
  for (int a = 0; a < kAngleCount; ++a) shown.angles[static_cast<size_t>(a)] = deviation[6 + a] < kShownDeviation;
  return shown;
}

Bridged bridge_gaps(const std::vector<HandState>& states, const std::vector<Observability>& shown,
                    const std::vector<double>& times_s) {
  check(states.size() == shown.size() && states.size() == times_s.size(), "one of each for a frame");
  Bridged result;
  result.states = states;
  result.angles.assign(states.size(), {});
  for (const Observability& frame : shown) result.poses.push_back(!frame.pose);
  const auto has_pose = [&](size_t f) { return shown[f].pose; };
  for (const auto& [f, gap] : gaps_of(states.size(), times_s, has_pose)) {
    result.states[f].T_capture_hand =
        between(states[gap.before].T_capture_hand, states[gap.after].T_capture_hand, gap.share);
  }
  for (int a = 0; a < kAngleCount; ++a) bridge_angle(a, shown, times_s, result);
  for (HandState& state : result.states) state.posture = clamp_to_limits(state.posture);
  return result;
}

}  // namespace glovebench::trajectories
