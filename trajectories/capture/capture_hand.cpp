#include "trajectories/capture/capture_hand.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/pose/horn.h"
#include "trajectories/capture/fit_frame.h"
#include "trajectories/capture/marker_sequence.h"

namespace glovebench::trajectories {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// The joint that each angle turns, and whether a joint hangs on it.
struct Turned {
  std::array<int, kAngleCount> joint;
  std::array<std::array<bool, kJointCount>, kAngleCount> carries = {};
};
const Turned& turned() {
  static const Turned table = [] {
    Turned result;
    for (size_t a = 0; a < kAngleCount; ++a) {
      result.joint[a] = joint_of_angle(static_cast<int>(a));
      for (int joint = 0; joint < kJointCount; ++joint) {
        for (int j = joint; j >= 0; j = joint_parents()[static_cast<size_t>(j)])
          if (j == result.joint[a]) result.carries[a][static_cast<size_t>(joint)] = true;
      }
    }
    return result;
  }();
  return table;
}

/// Farther off in the median: another posture may be nearer.
constexpr double kDoubtful = 0.006;

/// Fixed to the palm: whatever the posture is, it lies at one place in the hand frame.
bool is_on_palm(const PlacedMarker& marker) {
  if (marker.joint == kPalm) return true;
  return marker.is_joint_center() && joint_parents()[static_cast<size_t>(marker.joint)] < 0;
}

/// Two markers at one distance in every posture.
bool is_rigid_pair(const PlacedMarker& a, const PlacedMarker& b) {
  if (is_on_palm(a) && is_on_palm(b)) return true;
  if (!a.is_joint_center() || !b.is_joint_center()) return false;
  return joint_parents()[static_cast<size_t>(a.joint)] == b.joint ||
         joint_parents()[static_cast<size_t>(b.joint)] == a.joint;
}

/// Postures that a hand may begin with: flat, half closed, a fist, and pointing.
std::vector<Posture> first_postures() {
  const auto bent = [](double degrees) {
    Posture posture = Posture::Zero();
    for (int mcp = kIndexMcpFlexion; mcp < kAngleCount; mcp += 4)
      posture.segment<3>(mcp).setConstant(radians_from_degrees(degrees));
    posture[kThumbCmcAbduction] = posture[kThumbCmcFlexion] = radians_from_degrees(20);
    posture[kThumbMcpFlexion] = posture[kThumbIpFlexion] = radians_from_degrees(degrees / 2);
    return posture;
  };
  Posture pointing = bent(75);
  pointing.segment<4>(kIndexMcpAbduction).setZero();
  return {bent(0), bent(40), bent(75), pointing};
}

std::optional<Eigen::Isometry3d> palm_pose(const CaptureHand& hand, const Points& points) {
  const Points in_hand = predict_points(hand, {});
  std::vector<Eigen::Vector3f> from, to;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // small numbers for single precision
  for (size_t m = 0; m < points.size(); ++m) {
    if (!is_seen(points[m]) || !is_on_palm(hand.markers[m])) continue;
    if (from.empty()) center = points[m];
    from.push_back(in_hand[m].cast<float>());
    to.push_back((points[m] - center).cast<float>());
  }
  std::optional<Eigen::Isometry3d> T = align_points(from, to);
  if (T) T->pretranslate(center);
  return T;
}

double median_distance(const CaptureHand& hand, const Points& points, const HandState& state) {
  std::vector<double> seen;
  std::ranges::copy_if(point_distances(hand, points, state), std::back_inserter(seen),
                       [](double d) { return std::isfinite(d); });
  return quantile_of(std::move(seen), 0.5).value_or(0);
}

/// The best fit of a frame from its neighbor's state, if there is one, and from the palm's pose.
HandState start_state(const CaptureHand& hand, const Points& points, const HandState* neighbor, double scale) {
  const FrameFitOptions options{.robust_scale = scale};
  const std::optional<Eigen::Isometry3d> T_capture_palm = palm_pose(hand, points);
  HandState start = neighbor ? *neighbor : HandState{};
  if (T_capture_palm) start.T_capture_hand = *T_capture_palm;
  FrameFit best = fit_frame(hand, points, start, options);
  if (neighbor && median_distance(hand, points, best.state) < kDoubtful) return best.state;
  if (neighbor) start = *neighbor;
  for (const Posture& posture : first_postures()) {
    start.posture = posture;
    if (T_capture_palm) start.T_capture_hand = *T_capture_palm;
    const FrameFit fit = fit_frame(hand, points, start, options);
    if (fit.cost < best.cost) best = fit;
  }
  return best.state;
}

size_t best_start(const CaptureHand& hand, const std::vector<Points>& points, const std::string& where) {
  size_t best = 0;
  std::ptrdiff_t most = -1;
  for (size_t f = 0; f < points.size(); ++f) {
    const std::ptrdiff_t seen = std::ranges::count_if(points[f], is_seen);
    if (seen > most && palm_pose(hand, points[f])) best = f, most = seen;
  }
  if (most < 0) {
    throw Error(where, "points", "no frame with three on the palm",
                "at least three that the fingers do not move and that lie on no line");
  }
  return best;
}

/// The hand's size is the same in all frames: so many tell it.
constexpr size_t kScaleFrames = 100;

}  // namespace

HandState moved(const HandState& state, const StateStep& step) {
  HandState result = state;
  const Eigen::Vector3d turn = step.head<3>();
  if (turn.norm() > 0) {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * state.T_capture_hand.linear();
    result.T_capture_hand.linear() = Eigen::Quaterniond(R).normalized().toRotationMatrix();
  }
  result.T_capture_hand.translation() += step.segment<3>(3);
  result.posture = clamp_to_limits(state.posture + step.tail<kAngleCount>());
  return result;
}

Eigen::Isometry3d marker_frame(const PlacedMarker& marker, const JointPoses& T_hand_joint) {
  return marker.joint == kPalm ? Eigen::Isometry3d::Identity() : T_hand_joint[static_cast<size_t>(marker.joint)];
}

std::vector<Eigen::Vector3d> predict_points(const CaptureHand& hand, const HandState& state) {
  const JointPoses T_hand_joint = hand.skeleton.pose(state.posture);
  std::vector<Eigen::Vector3d> points;
  for (const PlacedMarker& marker : hand.markers)
    points.push_back(state.T_capture_hand * (marker_frame(marker, T_hand_joint) * marker.offset));
  return points;
}

Eigen::MatrixXd state_jacobian(const CaptureHand& hand, const HandState& state) {
  const JointPoses T_hand_joint = hand.skeleton.pose(state.posture);
  const std::array<Eigen::Vector3d, kAngleCount> axes = hand.skeleton.axes(T_hand_joint);
  const Eigen::Matrix3d R = state.T_capture_hand.linear();
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(static_cast<int>(3 * hand.markers.size()), kStateSize);
  for (size_t m = 0; m < hand.markers.size(); ++m) {
    const PlacedMarker& marker = hand.markers[m];
    const Eigen::Vector3d p_hand = marker_frame(marker, T_hand_joint) * marker.offset;
    auto rows = jacobian.middleRows<3>(static_cast<int>(3 * m));
    rows.leftCols<3>() = -cross_matrix(R * p_hand);
    rows.middleCols<3>(3).setIdentity();
    if (marker.joint == kPalm) continue;
    for (size_t a = 0; a < kAngleCount; ++a) {
      if (!turned().carries[a][static_cast<size_t>(marker.joint)]) continue;
      const Eigen::Vector3d center = T_hand_joint[static_cast<size_t>(turned().joint[a])].translation();
      rows.col(6 + static_cast<int>(a)) = R * axes[a].cross(p_hand - center);
    }
  }
  return jacobian;
}

double hand_scale(const CaptureHand& hand, const std::vector<Points>& points, const std::string& where) {
  constexpr double too_near = 0.015, smallest = 0.5, largest = 2;
  const Points in_hand = predict_points(hand, {});
  const size_t step = std::max<size_t>(1, points.size() / kScaleFrames);
  std::vector<double> ratios;
  for (size_t a = 0; a < in_hand.size(); ++a) {
    for (size_t b = a + 1; b < in_hand.size(); ++b) {
      const double length = (in_hand[a] - in_hand[b]).norm();
      if (length < too_near || !is_rigid_pair(hand.markers[a], hand.markers[b])) continue;
      for (size_t f = 0; f < points.size(); f += step) {
        const Eigen::Vector3d &p = points[f][a], &q = points[f][b];
        if (is_seen(p) && is_seen(q)) ratios.push_back((p - q).norm() / length);
      }
    }
  }
  const double scale = quantile_of(std::move(ratios), 0.5).value_or(1);
  if (!(scale >= smallest && scale <= largest)) {
    throw Error(where, "points", fmt::format("a hand of {:.3g} times the model's size", scale),
                fmt::format("{} to {} times; is the unit right?", smallest, largest));
  }
  return scale;
}

std::vector<HandState> start_states(const CaptureHand& hand, const std::vector<Points>& points, double robust_scale,
                                    const std::string& where) {
  const size_t first = best_start(hand, points, where);
  std::vector<HandState> states(points.size());
  states[first] = start_state(hand, points[first], nullptr, robust_scale);
  for (size_t f = first + 1; f < points.size(); ++f)
    states[f] = start_state(hand, points[f], &states[f - 1], robust_scale);
  for (size_t f = first; f-- > 0;) states[f] = start_state(hand, points[f], &states[f + 1], robust_scale);
  return states;
}

}  // namespace glovebench::trajectories
