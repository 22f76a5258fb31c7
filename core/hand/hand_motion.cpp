#include "core/hand/hand_motion.h"

#include <algorithm>

#include "core/base/error.h"

namespace glovebench {
namespace {

/// The mirror image of a left hand: the right hand that its skeleton speaks of, and back.
JointPoses mirrored(JointPoses poses) {
  const Eigen::DiagonalMatrix<double, 3> mirror(-1, 1, 1);
  for (Eigen::Isometry3d& T : poses) {
    T.linear() = mirror * T.linear() * mirror;
    T.translation().x() *= -1;
  }
  return poses;
}

/// The angles of a joint and of those it hangs on, as bits.
uint32_t angles_above(int joint) {
  uint32_t angles = 0;
  for (int a = 0; a < kAngleCount; ++a)
    for (int j = joint; j >= 0; j = joint_parents()[j])
      if (joint_of_angle(a) == j) angles |= uint32_t{1} << a;
  return angles;
}

/// Joints that the same angles move are one body.
struct Bodies {
  std::array<uint32_t, kBodyCount> angles{};
  std::array<uint8_t, kJointCount> of_joint{};
};

Bodies make_bodies() {
  Bodies bodies;
  int count = 1;
  for (int j = 0; j < kJointCount; ++j) {
    const auto known = bodies.angles.begin() + count;
    const auto body = std::find(bodies.angles.begin(), known, angles_above(j));
    if (body == known) {
      check(count < kBodyCount, "a hand has 17 bodies");
      bodies.angles[count++] = angles_above(j);
    }
    bodies.of_joint[j] = static_cast<uint8_t>(body - bodies.angles.begin());
  }
  check(count == kBodyCount, "a hand has 17 bodies");
  return bodies;
}

const Bodies& bodies_of_hand() {
  static const Bodies made = make_bodies();
  return made;
}

}  // namespace

std::array<Screw, kAngleCount> angle_screws(const HandModel& model, const PosedHand& hand) {
  const bool is_left = model.side() == Side::left;
  const JointPoses right = is_left ? mirrored(hand.T_hand_joint) : hand.T_hand_joint;
  const std::array<Eigen::Vector3d, kAngleCount> axes = model.skeleton().axes(right);
  std::array<Screw, kAngleCount> screws;
  for (int a = 0; a < kAngleCount; ++a) {
    // A mirror turns the sense of a rotation around.
    const Eigen::Vector3d axis = is_left ? Eigen::Vector3d(axes[a].x(), -axes[a].y(), -axes[a].z()) : axes[a];
    const Eigen::Vector3d& origin = hand.T_hand_joint[joint_of_angle(a)].translation();
    screws[a] = {axis, origin.cross(axis)};
  }
  return screws;
}

uint32_t angles_of_body(int body) { return bodies_of_hand().angles.at(body); }

std::vector<BodyShares> body_shares(const HandModel& model) {
  std::vector<BodyShares> shares;
  shares.reserve(model.vertex_count());
  for (const Influence& influence : model.influences()) {
    BodyShares& share = shares.emplace_back();
    share.fill(0);
    for (int i = 0; i < 4; ++i) share[bodies_of_hand().of_joint[influence.joint[i]]] += influence.weight[i];
  }
  return shares;
}

AngleShares angle_shares(const BodyShares& shares) {
  AngleShares result = AngleShares::Zero();
  for (int body = 0; body < kBodyCount; ++body)
    for (int a = 0; a < kAngleCount; ++a)
      if (angles_of_body(body) >> a & 1) result[a] += shares[body];
  return result;
}

}  // namespace glovebench
