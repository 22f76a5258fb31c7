#include "core/base/math.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace glovebench {
namespace {

TEST(RotationError, IsTheGeodesicAngle) {
  const Eigen::Matrix3d a = Eigen::AngleAxisd(0.7, Eigen::Vector3d(2, 1, -1).normalized()).toRotationMatrix();
  for (const double degrees : {0.0, 1e-3, 90.0, 179.0}) {
    const Eigen::AngleAxisd turn(radians_from_degrees(degrees), Eigen::Vector3d(1, -2, 3).normalized());
    EXPECT_NEAR(degrees_from_radians(angle_between(a, a * turn.toRotationMatrix())), degrees, 1e-6) << "rounding";
  }
}

TEST(NearestPoints, OfSegmentsAreAsFarApartAsASearchFinds) {
  RandomStream random(1, "math", 0, "segments");
  const auto point = [&] {
    return Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  };
  for (int number = 0; number < 200; ++number) {
    std::array<Eigen::Vector3d, 2> a = {point(), point()}, b = {point(), point()};
    if (number % 4 == 0) b = {a[0] + point(), Eigen::Vector3d::Zero()};
    if (number % 4 == 0) b[1] = b[0] + a[1] - a[0];  // parallel
    const auto [on_a, on_b] = nearest_points(a, b);
    double least = 10;
    constexpr int kParts = 100;
    for (int i = 0; i <= kParts; ++i)
      for (int k = 0; k <= kParts; ++k)
        least = std::min(least, (a[0] + (a[1] - a[0]) * i / kParts - b[0] - (b[1] - b[0]) * k / kParts).norm());
    EXPECT_LE((on_a - on_b).norm(), least + 1e-12);
    EXPECT_GE((on_a - on_b).norm(), least - 0.05);
    EXPECT_LT((on_a - a[0]).norm() + (on_a - a[1]).norm(), (a[0] - a[1]).norm() + 1e-9) << "on the segment";
    EXPECT_LT((on_b - b[0]).norm() + (on_b - b[1]).norm(), (b[0] - b[1]).norm() + 1e-9);
  }
}

}  // namespace
}  // namespace glovebench
