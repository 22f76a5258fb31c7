#include "render/subjects/capsule_skeleton.h"

#include "core/base/math.h"
#include "core/base/random.h"

namespace glovebench::render {
namespace {

constexpr int kThumbCmc = 1;
/// The MCP joints of index to little, and the base of their metacarpals one before.
constexpr std::array<int, 4> kMcp = {6, 11, 16, 21};

/// Shares of hand length: how far each MCP lies proximal of the middle one, and palmar of it (the palm's arch).
constexpr std::array<double, 4> kProximalOfMiddle = {0.008, 0, 0.027, 0.064};
constexpr std::array<double, 4> kPalmarOfMiddle = {0.016, 0, 0.006, 0.016};
/// Length of the metacarpals II to V (Buryanov and Kotiuk, Table I) as shares of the mean hand's length.
constexpr std::array<double, 4> kMetacarpal = {0.360, 0.341, 0.306, 0.284};
/// How far the metacarpals' bases are from the middle line, as a share of their heads' distance.
constexpr double kCarpalFan = 0.42;

/// Where the tip joint lies between the last joint and the end of the finger: at the same part of the hand as in
/// the package's mesh, in the middle of the pad.
constexpr std::array<double, 5> kTipAlong = {0.60, 0.51, 0.49, 0.50, 0.55};

double finger_length(const HandDimensions& hand, int finger) {
  const auto& s = hand.segments[finger];
  return s[0] + s[1] + s[2] + hand.pulp[finger];
}

Eigen::Isometry3d at(const Eigen::Vector3d& place) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = place;
  return T;
}

/// MCP joints index to little, relative to the middle one. Breadth is shared out by the fingers' girths.
std::array<Eigen::Vector3d, 4> knuckles(const HandDimensions& hand) {
  double girths = 0;
  for (int f = 0; f < 4; ++f) girths += hand.middle_girth[f + 1];
  std::array<double, 4> x{};
  double edge = 0;
  for (int f = 0; f < 4; ++f) {
    const double width = hand.breadth * hand.middle_girth[f + 1] / girths;
    x[f] = edge + width / 2;
    edge += width;
  }
  std::array<Eigen::Vector3d, 4> place;
  for (int f = 0; f < 4; ++f)
    place[f] = {x[f] - x[1], -kPalmarOfMiddle[f] * hand.length, kProximalOfMiddle[f] * hand.length};
  return place;
}

/// The joints of one finger from its first one on, each in line with the one before but for small deviations.
void place_chain(JointPoses& T_hand_joint, int first, const HandDimensions& hand, int finger, RandomStream& random,
                 double twist_deg) {
  const auto& lengths = hand.segments[finger];
  const std::array<double, 3> to_next = {lengths[0], lengths[1],
                                         kTipAlong[finger] * (lengths[2] + hand.pulp[finger])};
  const auto small = [&random](double sd_deg) {
    return radians_from_degrees(sd_deg * std::clamp(random.normal(), -2.0, 2.0));
  };
  const Eigen::AngleAxisd twist(radians_from_degrees(twist_deg) + small(1.5), Eigen::Vector3d::UnitZ());
  T_hand_joint[first].linear() = T_hand_joint[first].linear() * twist.toRotationMatrix();
  for (int s = 0; s < 3; ++s) {
    Eigen::Isometry3d T = at({0, 0, -to_next[s]});
    if (s < 2) T.linear() = Eigen::AngleAxisd(small(1.5), Eigen::Vector3d::UnitY()).toRotationMatrix();
    T_hand_joint[first + s + 1] = T_hand_joint[first + s] * T;
  }
}

}  // namespace

Skeleton make_skeleton(const HandDimensions& hand, const Skeleton& definition, uint64_t seed) {
  RandomStream random(seed, "capsule hand", 0, "skeleton");
  JointPoses T_hand_joint;
  T_hand_joint.fill(Eigen::Isometry3d::Identity());
  const double half = (hand.length - finger_length(hand, 2)) / 2;  // of wrist to middle MCP
  const Eigen::Vector3d wrist(0, 0, half);
  T_hand_joint[kWristJoint] = T_hand_joint[kForearmJoint] = at(wrist);

  // Flexed fingers lean to the middle: their axes are not parallel.
  constexpr std::array<double, 4> kTwist_deg = {3, 0, -3, -6};
  const std::array<Eigen::Vector3d, 4> knuckle = knuckles(hand);
  for (int f = 0; f < 4; ++f) {
    const Eigen::Vector3d mcp = Eigen::Vector3d(0, 0, -half) + knuckle[f];
    const Eigen::Vector3d base(kCarpalFan * mcp.x(), mcp.y() / 2, mcp.z() + kMetacarpal[f] * hand.length);
    T_hand_joint[kMcp[f] - 1] = at(base);
    T_hand_joint[kMcp[f]] = at(mcp);
    place_chain(T_hand_joint, kMcp[f], hand, f + 1, random, kTwist_deg[f]);
  }
  T_hand_joint[kThumbCmc] = at(wrist + hand.length * Eigen::Vector3d(-0.115, -0.055, -0.105));
  T_hand_joint[kThumbCmc].linear() = definition.pose(Posture::Zero())[kThumbCmc].linear();
  place_chain(T_hand_joint, kThumbCmc, hand, 0, random, 0);
  return Skeleton(T_hand_joint);
}

}  // namespace glovebench::render
