#include "reports/metrics/visibility.h"

#include <gtest/gtest.h>

namespace glovebench::reports {
namespace {

/// A camera of 100 by 100 pixels and a color camera 0.1 m to its right, both with f = 100: at z = 0.5 m the first
/// one sees x from -0.2525 to 0.2475 m, the second one from -0.1525 to 0.3475 m.
RgbdCalibration small_cameras() {
  RgbdCalibration calibration;
  calibration.ir = calibration.rgb = {100, 100, 100, 100, 50, 50};
  calibration.T_rgb_ir = Eigen::Translation3d(-0.1, 0, 0);
  return calibration;
}

/// A hand of right triangles with legs of 1 cm times `size` that face the camera or turn away from it.
class Facets {
 public:
  void add(const Eigen::Vector3f& centroid, float size = 1, bool faces = true) {
    const auto first = static_cast<uint32_t>(hand_.vertices.size());
    const float leg = 0.01F * size;
    const Eigen::Vector3f corner = centroid - Eigen::Vector3f(leg / 3, leg / 3, 0);
    hand_.vertices.push_back(corner);
    hand_.vertices.push_back(corner + Eigen::Vector3f(leg, 0, 0));
    hand_.vertices.push_back(corner + Eigen::Vector3f(0, leg, 0));
    // x right, y down: this order turns its outside to +z, away from the camera.
    triangles_.push_back({{first, first + 1, first + 2}, 1, 0});
    if (faces) std::swap(triangles_.back().vertices[1], triangles_.back().vertices[2]);
  }
  double percent(const Eigen::Isometry3d& T_camera_hand = Eigen::Isometry3d::Identity()) const {
    return visible_percent(hand_, triangles_, T_camera_hand, small_cameras());
  }

 private:
  PosedHand hand_;
  std::vector<Triangle> triangles_;
};

TEST(VisiblePercent, IsTheShareOfTheAreaThatFacesTheCamera) {
  Facets facets;
  EXPECT_EQ(facets.percent(), 0) << "nothing faces the camera";
  facets.add({0, 0, 0.5F});
  facets.add({0, 0, 0.6F}, 5, false);
  EXPECT_NEAR(facets.percent(), 100, 1e-4) << "what turns away does not count";
  facets.add({0.4F, 0, 0.5F}, 2);  // out of the image, four times the area
  EXPECT_NEAR(facets.percent(), 20, 1e-4);
}

TEST(VisiblePercent, BothImagesMustHoldIt) {
  const auto percent_at = [](float x, float y) {
    Facets facets;
    facets.add({x, y, 0.5F});
    return facets.percent();
  };
  EXPECT_EQ(percent_at(0.245F, 0), 100);
  EXPECT_EQ(percent_at(0.25F, 0), 0) << "right of the depth image";
  EXPECT_EQ(percent_at(-0.15F, 0), 100);
  EXPECT_EQ(percent_at(-0.155F, 0), 0) << "left of the color image";
  EXPECT_EQ(percent_at(0, -0.25F), 100);
  EXPECT_EQ(percent_at(0, -0.255F), 0);
  EXPECT_EQ(percent_at(0, 0.25F), 0);
}

TEST(VisiblePercent, TheVolumeMustHoldIt) {
  Facets facets;
  facets.add({0, 0, 0});
  const auto percent_at = [&](double z) {
    return facets.percent(Eigen::Isometry3d(Eigen::Translation3d(0, 0, z)));
  };
  EXPECT_EQ(percent_at(0.399), 0);
  EXPECT_EQ(percent_at(0.401), 100);
  EXPECT_EQ(percent_at(0.949), 100);
  EXPECT_EQ(percent_at(0.951), 0);
  EXPECT_EQ(percent_at(-0.5), 0) << "behind the camera, whose triangles then turn away";
}

}  // namespace
}  // namespace glovebench::reports
