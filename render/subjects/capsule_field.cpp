#include "render/subjects/capsule_field.h"

#include <algorithm>
#include <cmath>

namespace glovebench::render {
namespace {

/// The exponentials of a smooth union, summed up.
struct SoftSum {
  double sum = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();

  void add(double share, const FieldSample& sample, double k) {
    const double e = share * std::exp(-sample.value / k);
    sum += e;
    gradient += e * sample.gradient;
  }
  FieldSample result(double k) const { return {-k * std::log(sum), gradient / sum}; }
};

}  // namespace

FieldSample distance_to(const Capsule& capsule, const Eigen::Vector3d& p) {
  // The ball whose surface is nearest has its center where |p - c(t)| - r(t), which is convex, is least.
  const Eigen::Vector3d axis = capsule.b - capsule.a, from_a = p - capsule.a;
  const double length2 = axis.squaredNorm();
  const double taper = capsule.radius_a - capsule.radius_b;
  const double along = from_a.dot(axis);  // times the length
  const double across2 = std::max(0.0, from_a.squaredNorm() - along * along / length2);
  const double slope = taper / std::sqrt(std::max(length2 - taper * taper, 1e-12));
  const double t = std::clamp((along - std::sqrt(across2 * length2) * slope) / length2, 0.0, 1.0);
  const Eigen::Vector3d from_center = from_a - t * axis;
  const double distance = from_center.norm();
  const double radius = capsule.radius_a - t * taper;
  if (distance < 1e-9) return {-radius, Eigen::Vector3d::UnitY()};
  return {distance - radius, from_center / distance};
}

FieldSample smooth_union(std::span<const Capsule> capsules, std::span<const UnionPart> parts,
                         const Eigen::Vector3d& p) {
  SoftSum palm, all;
  for (const UnionPart& part : parts) {
    const FieldSample sample = distance_to(capsules[part.capsule], p);
    const bool in_palm = part.joining == Joining::palm;
    (in_palm ? palm : all).add(part.share, sample, in_palm ? kPalmJoining : kSegmentJoining);
  }
  if (palm.sum > 0) all.add(1, palm.result(kPalmJoining), kSegmentJoining);
  return all.result(kSegmentJoining);
}

Eigen::Vector3d project_to_level(std::span<const Capsule> capsules, std::span<const UnionPart> parts, double level,
                                 Eigen::Vector3d p) {
  constexpr int kMostSteps = 24;
  constexpr double kCloseEnough = 0.00001;  // m
  double longest_step = 0.003;              // m
  double last_off = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    const FieldSample sample = smooth_union(capsules, parts, p);
    const double off = sample.value - level;
    if (std::abs(off) < kCloseEnough) break;
    // In a crease the steps jump from one side to the other.
    if (off * last_off < 0) longest_step *= 0.5;
    last_off = off;
    // The gradient is shorter than 1 where parts meet.
    const double length = std::max(sample.gradient.norm(), 0.3);
    p -= std::clamp(off / length, -longest_step, longest_step) / length * sample.gradient;
  }
  return p;
}

}  // namespace glovebench::render
