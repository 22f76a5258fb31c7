#include "core/robot/shadow_kinematics.h"

#include <numbers>

namespace glovebench {
namespace {

constexpr double kWristSegment = 0.034;   // m, WRJ2 to WRJ1
constexpr double kKnuckleHeight = 0.099;  // of the middle finger
constexpr double kKnuckleSide = 0.011;

/// A joint, its place (mm) and axis in the frame of the one before it.
struct Link {
  ShadowJoint joint;
  std::array<double, 3> offset_mm;
  std::array<double, 3> axis;
};
struct Chain {
  double tilt;  ///< about y, of the first joint's frame
  std::array<Link, 5> links;
  int count;
  double tip_mm;  ///< from the last joint
};

using Axis = std::array<double, 3>;
constexpr Axis kX = {1, 0, 0}, kMinusY = {0, -1, 0}, kY = {0, 1, 0}, kMinusZ = {0, 0, -1};
// The fold of the palm: 55 degrees off the palm's x, as the model writes it.
constexpr Axis kFold = {0.573576436, 0, 0.819152044};

const std::array<Chain, 5>& chains() {
  static constexpr std::array<Chain, 5> chains = {{
      {std::numbers::pi / 4,
       {{{kTHJ5, {34, -8.5, 29}, kMinusZ},
         {kTHJ4, {0, 0, 0}, kX},
         {kTHJ3, {0, 0, 38}, kX},
         {kTHJ2, {0, 0, 0}, kMinusY},
         {kTHJ1, {0, 0, 32}, kMinusY}}},
       5,
       27.5},
      {0,
       {{{kFFJ4, {33, 0, 95}, kMinusY}, {kFFJ3, {}, kX}, {kFFJ2, {0, 0, 45}, kX}, {kFFJ1, {0, 0, 25}, kX}}},
       4,
       26},
      {0,
       {{{kMFJ4, {11, 0, 99}, kMinusY}, {kMFJ3, {}, kX}, {kMFJ2, {0, 0, 45}, kX}, {kMFJ1, {0, 0, 25}, kX}}},
       4,
       26},
      {0, {{{kRFJ4, {-11, 0, 95}, kY}, {kRFJ3, {}, kX}, {kRFJ2, {0, 0, 45}, kX}, {kRFJ1, {0, 0, 25}, kX}}}, 4, 26},
      {0,
       {{{kLFJ5, {-33, 0, 20.71}, kFold},
         {kLFJ4, {0, 0, 65.79}, kY},
         {kLFJ3, {}, kX},
         {kLFJ2, {0, 0, 45}, kX},
         {kLFJ1, {0, 0, 25}, kX}}},
       5,
       26},
  }};
  return chains;
}

Eigen::Vector3d vector(const std::array<double, 3>& values) {
  return Eigen::Vector3d(values[0], values[1], values[2]);
}

/// A finger's tip and, in the palm frame, where each of its joints is and about what it turns.
struct PosedChain {
  std::array<Eigen::Vector3d, 5> origins, axes;
  Eigen::Vector3d tip;
};

PosedChain pose(const Chain& chain, const std::array<double, kShadowJointCount>& joints) {
  PosedChain posed;
  Eigen::Isometry3d T_palm_link = Eigen::Isometry3d::Identity();
  for (int i = 0; i < chain.count; ++i) {
    const Link& link = chain.links[i];
    T_palm_link.translate(vector(link.offset_mm) / 1000);
    if (i == 0) T_palm_link.rotate(Eigen::AngleAxisd(chain.tilt, Eigen::Vector3d::UnitY()));
    const Eigen::Vector3d axis = vector(link.axis).normalized();
    posed.origins[i] = T_palm_link.translation();
    posed.axes[i] = T_palm_link.linear() * axis;
    T_palm_link.rotate(Eigen::AngleAxisd(joints[link.joint], axis));
  }
  posed.tip = T_palm_link * Eigen::Vector3d(0, 0, chain.tip_mm / 1000);
  return posed;
}

}  // namespace

const Eigen::Isometry3d& shadow_T_hand_palm() {
  static const Eigen::Isometry3d T_hand_palm = [] {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = Eigen::Vector3d(-1, 1, -1).asDiagonal();
    T.translation() = -(T.linear() * Eigen::Vector3d(kKnuckleSide, 0, kKnuckleHeight)) / 2;
    return T;
  }();
  return T_hand_palm;
}

Fingertips shadow_fingertips(const std::array<double, kShadowJointCount>& joints) {
  Fingertips tips;
  for (int f = 0; f < 5; ++f) tips.col(f) = shadow_T_hand_palm() * pose(chains()[f], joints).tip;
  return tips;
}

FingertipJacobian shadow_fingertip_jacobian(const std::array<double, kShadowJointCount>& joints) {
  FingertipJacobian J = FingertipJacobian::Zero();
  for (int f = 0; f < 5; ++f) {
    const PosedChain posed = pose(chains()[f], joints);
    for (int i = 0; i < chains()[f].count; ++i)
      J.block<3, 1>(3 * f, chains()[f].links[i].joint) =
          shadow_T_hand_palm().linear() * posed.axes[i].cross(posed.tip - posed.origins[i]);
  }
  return J;
}

Eigen::Isometry3d shadow_T_wrist_hand(const std::array<double, kShadowJointCount>& joints) {
  return Eigen::AngleAxisd(joints[kWRJ2], Eigen::Vector3d::UnitY()) * Eigen::Translation3d(0, 0, kWristSegment) *
         Eigen::AngleAxisd(joints[kWRJ1], Eigen::Vector3d::UnitX()) * shadow_T_hand_palm().inverse();
}

}  // namespace glovebench
