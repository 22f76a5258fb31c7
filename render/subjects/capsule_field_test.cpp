#include "render/subjects/capsule_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.h"

namespace glovebench::render {
namespace {

const std::vector<Capsule>& three_capsules() {
  static const std::vector<Capsule> capsules = {{{0, 0, 0}, {0, 0, -0.05}, 0.011, 0.008},
                                                {{0, 0, -0.05}, {0.02, -0.03, -0.05}, 0.008, 0.008},
                                                {{-0.02, 0, 0.01}, {0.03, 0.01, 0.02}, 0.012, 0.015}};
  return capsules;
}

const std::vector<UnionPart>& all_parts() {
  static const std::vector<UnionPart> parts = {
      {0, Joining::segment, 1}, {1, Joining::segment, 1}, {2, Joining::palm, 1}};
  return parts;
}

Eigen::Vector3d random_place(RandomStream& random) {
  return {random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), random.uniform(-0.08, 0.05)};
}

TEST(CapsuleField, DistanceIsThatOfTheNearestOfItsBalls) {
  RandomStream random(1, "capsule field test", 0, "places");
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d p = random_place(random);
    for (const Capsule& c : three_capsules()) {
      double least = 1;
      constexpr int kBalls = 20000;
      for (int b = 0; b <= kBalls; ++b) {
        const double t = static_cast<double>(b) / kBalls;
        least = std::min(least, (p - (1 - t) * c.a - t * c.b).norm() - ((1 - t) * c.radius_a + t * c.radius_b));
      }
      // The distance is least at the nearest ball: sampling is off by the square of the step.
      ASSERT_NEAR(distance_to(c, p).value, least, 1e-8);
    }
  }
}

TEST(CapsuleField, GradientsAreDerivatives) {
  RandomStream random(2, "capsule field test", 0, "places");
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d p = random_place(random);
    const auto field = [](const Eigen::Vector3d& q) { return smooth_union(three_capsules(), all_parts(), q); };
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
      const double slope = (field(p + step).value - field(p - step).value) / (2 * kStep);
      ASSERT_NEAR(field(p).gradient[axis], slope, 1e-4);
    }
  }
}

TEST(CapsuleField, UnionHoldsItsPartsAndAShareOfNothingIsNoPart) {
  RandomStream random(3, "capsule field test", 0, "places");
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d p = random_place(random);
    double least = 1;
    for (const Capsule& c : three_capsules()) least = std::min(least, distance_to(c, p).value);
    const double value = smooth_union(three_capsules(), all_parts(), p).value;
    ASSERT_LE(value, least + 1e-12);
    ASSERT_GE(value, least - kSegmentJoining * std::log(3.0) - 1e-12);
    std::vector<UnionPart> first_only = all_parts();
    first_only[1].share = first_only[2].share = 0;
    ASSERT_NEAR(smooth_union(three_capsules(), first_only, p).value, distance_to(three_capsules()[0], p).value,
                1e-12);
  }
}

TEST(CapsuleField, ProjectionReachesTheLevel) {
  RandomStream random(4, "capsule field test", 0, "places");
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d start = random_place(random);
    const double before = smooth_union(three_capsules(), all_parts(), start).value;
    if (std::abs(before - 0.001) > 0.01) continue;
    const Eigen::Vector3d p = project_to_level(three_capsules(), all_parts(), 0.001, start);
    ASSERT_NEAR(smooth_union(three_capsules(), all_parts(), p).value, 0.001, 2e-5);
    ASSERT_LT((p - start).norm(), 0.02);
  }
}

}  // namespace
}  // namespace glovebench::render
