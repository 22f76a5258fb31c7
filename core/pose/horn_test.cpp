#include "core/pose/horn.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace glovebench {
namespace {

std::vector<Eigen::Vector3f> cloud(int count) {
  RandomStream random(1, "horn", 0, "points");
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i)
    points.emplace_back(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(0.6, 0.8));
  return points;
}

TEST(Horn, recovers_any_rigid_motion) {
  const std::vector<Eigen::Vector3f> from = cloud(50);
  for (const double angle : {0.0, 0.3, 1.5, 3.14}) {
    Eigen::Isometry3d T =
        Eigen::Translation3d(0.1, -0.2, 0.3) * Eigen::AngleAxisd(angle, Eigen::Vector3d(1, -2, 0.5).normalized());
    std::vector<Eigen::Vector3f> to;
    for (const Eigen::Vector3f& p : from) to.push_back((T * p.cast<double>()).cast<float>());
    const auto estimate = align_points(from, to);
    ASSERT_TRUE(estimate);
    EXPECT_LT((estimate->matrix() - T.matrix()).norm(), 1e-5);  // float points at 1 m
  }
}

TEST(Horn, never_answers_with_a_reflection) {
  const std::vector<Eigen::Vector3f> from = cloud(50);
  std::vector<Eigen::Vector3f> to;
  for (const Eigen::Vector3f& p : from) to.emplace_back(-p.x(), p.y(), p.z());
  EXPECT_NEAR(align_points(from, to)->linear().determinant(), 1, 1e-12);
}

TEST(Horn, says_no_to_two_points_and_to_a_line) {
  const std::vector<Eigen::Vector3f> two = cloud(2);
  EXPECT_FALSE(align_points(two, two));
  std::vector<Eigen::Vector3f> line;
  for (int i = 0; i < 20; ++i) line.emplace_back(0.01f * i, 0.02f * i, 0.7f);
  EXPECT_FALSE(align_points(line, line));
}

}  // namespace
}  // namespace glovebench
