#include "trajectories/capture/bridge_gaps.h"

#include "core/base/error.h"
#include "trajectories/generation/natural_variation.h"

namespace glovebench::trajectories {
namespace {

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
  for (size_t f = 0; f < count; ++f) {
    if (is_shown(f)) shown.push_back(f);
  }
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

bool is_end_joint(int angle) {
  return angle >= kIndexDipFlexion && (angle - kIndexDipFlexion) % 4 == 0;
}

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
