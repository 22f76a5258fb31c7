#include "render/subjects/hand_capsules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace glovebench::render {
namespace {

constexpr double kPi = std::numbers::pi;
/// Two capsules that share a ball at a joint bulge there by k log 2.
constexpr double kBulge = kSegmentJoining * std::numbers::ln2;

/// Builds the list, in the order of the hand: fingers, thumb, metacarpals, webs, pads, forearm.
class CapsuleBuilder {
 public:
  CapsuleBuilder(const HandDimensions& hand, const Skeleton& skeleton)
      : hand_(hand), T_hand_joint_(skeleton.pose(Posture::Zero())), unit_(hand.breadth / 0.088) {}

  std::vector<HandCapsule> build() {
    add_fingers();
    add_thumb();
    add_metacarpals();
    add_webs();
    add_pads();
    add_forearm();
    return std::move(capsules_);
  }

 private:
  Eigen::Vector3d joint(int j) const { return T_hand_joint_[j].translation(); }
  /// An end that is fixed to the palm, from its place in the hand frame.
  CapsuleEnd palm(const Eigen::Vector3d& p_hand, const Eigen::Vector3d& arched = Eigen::Vector3d::Zero()) const {
    return {kWristJoint, T_hand_joint_[kWristJoint].inverse() * p_hand, arched};
  }
  /// Millimetres of a hand of 88 mm breadth.
  double mm(double value) const { return value / 1000 * unit_; }
  Eigen::Vector3d mm(double x, double y, double z) const { return {mm(x), mm(y), mm(z)}; }

  void add(const CapsuleEnd& a, double radius_a, const CapsuleEnd& b, double radius_b, Joining joining, int ray) {
    capsules_.push_back({a, b, radius_a, radius_b, joining, ray});
  }
  /// The capsules of a chain of segments: `radii` at its joints and at its tip's ball.
  void add_chain(int first_joint, std::span<const double> lengths, std::span<const double> radii, int ray) {
    for (size_t s = 0; s < lengths.size(); ++s) {
      const int j = first_joint + static_cast<int>(s);
      const bool last = s + 1 == lengths.size();
      const double length = last ? lengths[s] - radii[s + 1] : lengths[s];
      add({j, {0, 0, 0}}, radii[s], {j, {0, 0, -length}}, radii[s + 1], Joining::segment, ray);
    }
  }

  void add_fingers() {
    for (int f = 1; f < 5; ++f) {
      const auto& s = hand_.segments[f];
      const double middle = hand_.middle_girth[f] / (2 * kPi) - kBulge;
      const double distal = hand_.distal_girth[f - 1] / (2 * kPi) - kBulge;
      add_chain(1 + 5 * f, std::array{s[0], s[1], s[2] + hand_.pulp[f]},
                std::array{1.02 * middle, middle, distal, 0.84 * distal}, f);
    }
  }

  void add_thumb() {
    const auto& s = hand_.segments[0];
    const double radius = hand_.middle_girth[0] / (2 * kPi) - kBulge;
    add_chain(2, std::array{s[1], s[2] + hand_.pulp[0]}, std::array{1.04 * radius, radius, 0.80 * radius}, 0);
    // The metacarpal, and the thenar on its palmar and ulnar side.
    add({1, {0, 0, 0}}, mm(12), {1, {0, 0, -s[0]}}, 1.0 * radius, Joining::palm, 0);
    add(palm(joint(1) + mm(9, -4, -6)), mm(14), {1, {mm(2), -mm(4), -0.72 * s[0]}}, mm(11), Joining::palm, 0);
  }

  void add_metacarpals() {
    constexpr std::array<double, 4> kArch_mm = {0, 0, -1.5, -3};
    for (int f = 1; f < 5; ++f) {
      const int mcp = 1 + 5 * f;
      const double head = 0.78 * hand_.middle_girth[f] / (2 * kPi);
      add(palm(joint(mcp - 1)), mm(11.5), palm(joint(mcp), {0, mm(kArch_mm[f - 1]), 0}), head, Joining::palm, f);
    }
  }

  void add_webs() {
    // Between the fingers: from one proximal segment to the next, where the web's edge is.
    for (int f = 1; f < 4; ++f) {
      const double reach = mm(6.5);
      add({1 + 5 * f, {0, -mm(1), -reach}}, mm(5), {6 + 5 * f, {0, -mm(1), -reach}}, mm(5), Joining::palm, -1);
    }
    // Between thumb and index: skin that spans from one metacarpal to the other.
    const Eigen::Vector3d base = joint(5), head = joint(6);
    for (const double along : {0.35, 0.62}) {
      const double radius = mm(along < 0.5 ? 9 : 6.5);
      add({1, {0, -mm(1), -along * hand_.segments[0][0]}}, radius,
          palm(base + (along + 0.08) * (head - base) + mm(-2, -4, 0)), radius, Joining::palm, -1);
    }
  }

  void add_pads() {
    const Eigen::Vector3d arched = mm(-2, -4, 0);
    // The hypothenar, along the little finger's metacarpal.
    add(palm(joint(20) + mm(5, -6, 2)), mm(12.5), palm(joint(21) + mm(-3, -5, 14), arched), mm(8), Joining::palm,
        4);
    // The pad under the heads of the metacarpals.
    add(palm(joint(6) + mm(4, -5, 6)), mm(7), palm(joint(21) + mm(-6, -4, 6), arched), mm(6.5), Joining::palm, -1);
    // The carpus.
    const Eigen::Vector3d wrist = joint(kWristJoint);
    add(palm(wrist + mm(-11, 0, -6)), mm(14), palm(wrist + mm(11, -1, -6)), mm(14), Joining::palm, -1);
  }

  /// Two capsules side by side make an oval cross section.
  void add_forearm() {
    const double thickness = hand_.wrist_girth / kPi - 0.35 * (hand_.wrist_breadth - hand_.wrist_girth / kPi);
    const double radius = thickness / 2 - 0.0045;
    const double offset = hand_.wrist_breadth / 2 - radius - 0.001;
    for (const double x : {-offset, offset}) {
      add({kForearmJoint, {x, 0, 0}}, radius, {kForearmJoint, {1.06 * x, 0, 0.08}}, 1.06 * radius, Joining::palm,
          -1);
    }
  }

  const HandDimensions& hand_;
  JointPoses T_hand_joint_;
  double unit_;
  std::vector<HandCapsule> capsules_;
};

}  // namespace

std::vector<HandCapsule> make_capsules(const HandDimensions& hand, const Skeleton& skeleton) {
  return CapsuleBuilder(hand, skeleton).build();
}

std::vector<Capsule> place_capsules(const std::vector<HandCapsule>& capsules, const JointPoses& T_hand_joint,
                                    const Posture& posture) {
  // Ring and little finger arch the palm: their metacarpals are the ones that move.
  const double arch =
      std::sin(std::clamp((posture[kRingMcpFlexion] + posture[kLittleMcpFlexion]) / 2, 0.0, std::numbers::pi / 2));
  const auto place = [&](const CapsuleEnd& end) -> Eigen::Vector3d {
    return T_hand_joint[end.joint] * (end.place + arch * end.arched);
  };
  std::vector<Capsule> placed;
  placed.reserve(capsules.size());
  for (const HandCapsule& c : capsules) placed.push_back({place(c.a), place(c.b), c.radius_a, c.radius_b});
  return placed;
}

}  // namespace glovebench::render
