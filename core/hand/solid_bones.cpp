#include "core/hand/solid_bones.h"

#include <vector>

#include "core/base/math.h"

namespace glovebench {
namespace {

/// A capsule from a joint to the next, of a finger or of the palm.
struct SolidBone {
  int finger;
  int segment;  ///< 0 is the one at the knuckle, of the thumb the metacarpal
  int from;
  int to;
  double radius;  ///< m
  uint32_t angles = 0;
};

/// Radii are those of the mesh: median distance from the bone at the middle of each segment; the palm's is half
/// its thickness.
std::vector<SolidBone> make_solid_bones() {
  constexpr std::array<std::array<double, 3>, 5> radii_mm = {
      {{12, 9.8, 9.2}, {9.5, 8.1, 7.3}, {9.5, 8.4, 7.5}, {8.8, 8.0, 7.0}, {8.1, 6.9, 6.3}}};
  constexpr double palm_mm = 12;
  constexpr std::array<int, 5> first_joints = {1, 6, 11, 16, 21};  // of skeleton.h
  std::vector<SolidBone> bones;
  for (int finger = 0; finger < kPalmOfBones; ++finger) {
    const int first = first_joints[finger];
    for (int s = 0; s < 3; ++s) {
      bones.push_back({finger, s, first + s, first + s + 1, radii_mm[finger][s] / 1000});
      for (int a = 0; a < kAngleCount; ++a)
        if (const int joint = joint_of_angle(a); joint >= first && joint <= first + s)
          bones.back().angles |= uint32_t{1} << a;
    }
    if (finger > 0) bones.push_back({kPalmOfBones, 0, first - 1, first, palm_mm / 1000});
  }
  return bones;
}

/// False for bones that always touch: those of one finger, of the palm, and at a knuckle.
bool can_collide(const SolidBone& a, const SolidBone& b) {
  if (a.finger == b.finger) return false;
  if (a.finger != kPalmOfBones && b.finger != kPalmOfBones) return true;
  const SolidBone& finger = a.finger == kPalmOfBones ? b : a;
  return finger.segment >= (finger.finger == 0 ? 2 : 1);
}

}  // namespace

RecycledVector<BonePair> overlapping_bones(const JointPoses& T_hand_joint, double least) {
  static const std::vector<SolidBone> bones = make_solid_bones();
  const auto place = [&](int joint) -> Eigen::Vector3d { return T_hand_joint[joint].translation(); };
  RecycledVector<BonePair> pairs;
  for (size_t i = 0; i < bones.size(); ++i) {
    for (size_t k = 0; k < i; ++k) {
      const SolidBone &a = bones[i], &b = bones[k];
      if (!can_collide(a, b)) continue;
      const auto nearest = nearest_points({place(a.from), place(a.to)}, {place(b.from), place(b.to)});
      const double overlap = a.radius + b.radius - (nearest[0] - nearest[1]).norm();
      if (overlap > least) pairs.push_back({{a.finger, b.finger}, {a.angles, b.angles}, nearest, overlap});
    }
  }
  return pairs;
}

}  // namespace glovebench
