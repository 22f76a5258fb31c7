#include "render/subjects/capsule_glove.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace glovebench::render {
namespace {

// As in core/hand/glove.cpp: the same layout of the patches.
constexpr double kFrontBackWeight = 0.05;
constexpr double kRampLength = 0.015;    // m over which a segment's weight changes
constexpr double kSideWidth = 0.03;      // m
constexpr double kCuffRamp = 0.005;      // m
constexpr double kCuffBegin = 0.002;     // m past the wrist joint
constexpr double kFingerBegin = 0.004;   // m past the MCP joint
constexpr double kThumbBegin = 0.002;    // m past the MCP joint
constexpr double kThenarBegin = 0.024;   // m from the wrist joint
constexpr double kThenarReach = 0.003;   // m beyond the middle between the thumb and the palm
constexpr double kSideRadius = 0.012;    // m: of the palm's sides, where front and back meet
constexpr double kRaySoftness = 0.0025;  // m
constexpr double kOwnShare = 2.0 / 3;    // of a border's shift, the rest changes along it

double lattice_value(uint64_t seed, const Eigen::Vector3i& cell) {
  // SplitMix64's finalizer over the cell's coordinates.
  uint64_t h = seed;
  for (const int c : {cell.x(), cell.y(), cell.z()}) {
    h += 0x9e3779b97f4a7c15u + static_cast<uint64_t>(static_cast<int64_t>(c));
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    h ^= h >> 31;
  }
  return static_cast<double>(h >> 11) * 0x1.0p-52 - 1;
}

double ramp(double along) { return std::clamp(0.5 + along / kRampLength, 0.0, 1.0); }

}  // namespace

double smooth_noise(uint64_t seed, const Eigen::Vector3d& p, const Eigen::Vector3d& scale) {
  const Eigen::Vector3d q = p.cwiseQuotient(scale);
  const Eigen::Vector3d floor = q.array().floor();
  const Eigen::Vector3i cell = floor.cast<int>();
  Eigen::Vector3d f = q - floor;
  f = f.array().square() * (3 - 2 * f.array());
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3i offset(corner & 1, corner >> 1 & 1, corner >> 2);
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis) weight *= offset[axis] == 1 ? f[axis] : 1 - f[axis];
    sum += weight * lattice_value(seed, cell + offset);
  }
  return sum;
}

CapsuleGlove::CapsuleGlove(const std::vector<HandCapsule>& capsules, std::vector<Capsule> placed,
                           const JointPoses& T_hand_joint, uint64_t seed)
    : capsules_(capsules),
      placed_(std::move(placed)),
      z_wrist_(T_hand_joint[kWristJoint].translation().z()),
      x_middle_(T_hand_joint[joint_index("middle-finger-phalanx-proximal")].translation().x()) {
  for (int j = 0; j < kJointCount; ++j) T_joint_hand_[j] = T_hand_joint[j].inverse();
  RandomStream random(seed, "capsule hand", 0, "glove");
  seed_ = random.bits();
  for (double& shift : own_shift_) shift = kOwnShare * kMostBorderShift * random.uniform(-1, 1);
  fold_depth_ = random.uniform(kLeastFold, kMostFold);
}

double CapsuleGlove::shift(int border, const Eigen::Vector3d& p) const {
  const Eigen::Vector3d scale = Eigen::Vector3d::Constant(0.010);
  return own_shift_[border] +
         (1 - kOwnShare) * kMostBorderShift * smooth_noise(seed_ + static_cast<uint64_t>(border), p, scale);
}

std::array<double, 5> CapsuleGlove::ray_shares(const Eigen::Vector3d& p) const {
  std::array<double, 5> nearest;
  nearest.fill(1);
  for (size_t c = 0; c < capsules_.size(); ++c) {
    const int ray = capsules_[c].ray;
    if (ray >= 0) nearest[ray] = std::min(nearest[ray], distance_to(placed_[c], p).value);
  }
  nearest[0] -= kThenarReach;
  const double least = *std::min_element(nearest.begin(), nearest.end());
  double sum = 0;
  for (double& share : nearest) sum += share = std::exp((least - share) / kRaySoftness);
  for (double& share : nearest) share /= sum;
  return nearest;
}

PatchScores CapsuleGlove::scores(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const {
  PatchScores scores{};
  const std::array<double, 5> rays = ray_shares(p);
  const auto past = [&](int joint, int border, double begin = 0) {
    return ramp(-(T_joint_hand_[joint] * p).z() - begin - shift(border, p));
  };
  // Segments are numbered as their patches; a finger's first joint is its MCP, the thumb's too.
  const double thumb = past(2, kThumbProximal, kThumbBegin), thumb_distal = past(3, kThumbDistal);
  const double thenar = ramp(z_wrist_ - p.z() - kThenarBegin - shift(kThenar, p));
  scores[kThenar] = std::min(rays[0], thenar) * (1 - thumb);
  scores[kThumbProximal] = rays[0] * (thumb - thumb_distal);
  scores[kThumbDistal] = rays[0] * thumb_distal;
  double palm = rays[0] * (1 - thumb) - scores[kThenar];
  for (int f = 1; f < 5; ++f) {
    const int joint = 1 + 5 * f, patch = kIndexProximal + 3 * (f - 1);
    const std::array<double, 3> beyond = {past(joint, patch, kFingerBegin), past(joint + 1, patch + 1),
                                          past(joint + 2, patch + 2)};
    palm += rays[f] * (1 - beyond[0]);
    scores[patch] = rays[f] * (beyond[0] - beyond[1]);
    scores[patch + 1] = rays[f] * (beyond[1] - beyond[2]);
    scores[patch + 2] = rays[f] * beyond[2];
  }
  const double dorsal = kFrontBackWeight * (normal.y() + shift(kBackRadial, p) / kSideRadius);
  const double ulnar = kFrontBackWeight * (p.x() - x_middle_ - shift(kPalmUlnar, p)) / kSideWidth;
  scores[kPalmRadial] = palm - dorsal - ulnar;
  scores[kPalmUlnar] = palm - dorsal + ulnar;
  scores[kBackRadial] = palm + dorsal - ulnar;
  scores[kBackUlnar] = palm + dorsal + ulnar;
  scores[kCuff] = 1 + (p.z() - z_wrist_ - kCuffBegin - shift(kCuff, p)) / kCuffRamp;
  return scores;
}

std::vector<double> CapsuleGlove::folds(const std::vector<Eigen::Vector3d>& places) const {
  std::vector<double> heights;
  heights.reserve(places.size());
  for (const Eigen::Vector3d& p : places) heights.push_back(smooth_noise(seed_ + 100, p, {0.014, 0.014, 0.005}));
  if (heights.empty()) return heights;
  const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
  const double scale = fold_depth_ / std::max(*highest - *lowest, 1e-9);
  double mean = 0;
  for (const double h : heights) mean += h / static_cast<double>(heights.size());
  for (double& h : heights) h = scale * (h - mean);
  return heights;
}

}  // namespace glovebench::render
