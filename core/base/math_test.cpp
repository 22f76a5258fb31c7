#include "core/base/math.h"

#include <gtest/gtest.h>

namespace glovebench {
namespace {

TEST(RotationError, IsTheGeodesicAngle) {
  const Eigen::Matrix3d a = Eigen::AngleAxisd(0.7, Eigen::Vector3d(2, 1, -1).normalized()).toRotationMatrix();
  for (const double degrees : {0.0, 1e-3, 90.0, 179.0}) {
    const Eigen::AngleAxisd turn(radians_from_degrees(degrees), Eigen::Vector3d(1, -2, 3).normalized());
    EXPECT_NEAR(degrees_from_radians(angle_between(a, a * turn.toRotationMatrix())), degrees, 1e-6) << "rounding";
  }
}

}  // namespace
}  // namespace glovebench
