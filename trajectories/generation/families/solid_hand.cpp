#include "trajectories/generation/families/solid_hand.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace glovebench::trajectories {
namespace {

constexpr int kPalm = 5;  // after the five fingers, thumb first

/// A capsule from a joint to the next, of a finger or of the palm.
struct SolidBone {
  int finger;
  int segment;  ///< 0 is the one at the knuckle, of the thumb the metacarpal
  int from;
  int to;
  double radius;  ///< m
};

/// Radii are those of the mesh: median distance from the bone at the middle of each segment; the palm's is half
/// its thickness.
std::vector<SolidBone> make_solid_bones() {
  constexpr std::array<std::array<double, 3>, 5> radii_mm = {
      {{12, 9.8, 9.2}, {9.5, 8.1, 7.3}, {9.5, 8.4, 7.5}, {8.8, 8.0, 7.0}, {8.1, 6.9, 6.3}}};
  constexpr double palm_mm = 12;
  constexpr std::array<int, 5> first_joints = {1, 6, 11, 16, 21};  // of skeleton.h
  std::vector<SolidBone> bones;
  for (int finger = 0; finger < kPalm; ++finger) {
    const int first = first_joints[finger];
    for (int s = 0; s < 3; ++s) bones.push_back({finger, s, first + s, first + s + 1, radii_mm[finger][s] / 1000});
    if (finger > 0) bones.push_back({kPalm, 0, first - 1, first, palm_mm / 1000});
  }
  return bones;
}

/// True if two bones may be apart. A finger's own bones, those of the palm, and the bones at a knuckle never are.
bool may_be_apart(const SolidBone& a, const SolidBone& b) {
  if (a.finger == b.finger) return false;
  if (a.finger != kPalm && b.finger != kPalm) return true;
  const SolidBone& finger = a.finger == kPalm ? b : a;
  return finger.segment >= (finger.finger == 0 ? 2 : 1);
}

/// The least distance of two segments.
double segment_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& a_end, const Eigen::Vector3d& b,
                        const Eigen::Vector3d& b_end) {
  const Eigen::Vector3d along_a = a_end - a, along_b = b_end - b, between = a - b;
  const double aa = along_a.squaredNorm(), bb = along_b.squaredNorm(), ab = along_a.dot(along_b);
  const double a_between = along_a.dot(between), b_between = along_b.dot(between);
  const double determinant = aa * bb - ab * ab;
  constexpr double parallel = 1e-9;  // of aa * bb
  double s = determinant > parallel * aa * bb ? (ab * b_between - a_between * bb) / determinant : 0;
  s = std::clamp(s, 0.0, 1.0);
  const double t = std::clamp((ab * s + b_between) / bb, 0.0, 1.0);
  s = std::clamp((ab * t - a_between) / aa, 0.0, 1.0);
  return (between + s * along_a - t * along_b).norm();
}

}  // namespace

double deepest_overlap(const Skeleton& skeleton, const Posture& posture) {
  static const std::vector<SolidBone> bones = make_solid_bones();
  const JointPoses T_hand_joint = skeleton.pose(posture);
  const auto place = [&](int joint) -> Eigen::Vector3d { return T_hand_joint[joint].translation(); };
  double deepest = -std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < bones.size(); ++i) {
    for (size_t k = 0; k < i; ++k) {
      const SolidBone &a = bones[i], &b = bones[k];
      if (!may_be_apart(a, b)) continue;
      const double apart = segment_distance(place(a.from), place(a.to), place(b.from), place(b.to));
      deepest = std::max(deepest, a.radius + b.radius - apart);
    }
  }
  return deepest;
}

}  // namespace glovebench::trajectories
