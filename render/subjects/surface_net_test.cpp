#include "render/subjects/surface_net.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace glovebench::render {
namespace {

double volume(const SurfaceNet& net) {
  double sum = 0;
  for (const auto& t : net.triangles)
    sum += net.vertices[t[0]].dot(net.vertices[t[1]].cross(net.vertices[t[2]])) / 6;
  return sum;
}

TEST(SurfaceNet, OfABallIsClosedAndLooksOutwards) {
  const SurfaceNet net =
      polygonize_field([](const Eigen::Vector3d& p) { return p.norm() - 0.02; },
                       {Eigen::Vector3d(-0.03, -0.03, -0.03), Eigen::Vector3d(0.03, 0.03, 0.03)}, 0.002);
  EXPECT_TRUE(is_closed(net.triangles));
  for (const Eigen::Vector3d& p : net.vertices) ASSERT_NEAR(p.norm(), 0.02, 0.0003);
  EXPECT_NEAR(volume(net) / (4.0 / 3 * std::numbers::pi * 0.02 * 0.02 * 0.02), 1, 0.03);
}

TEST(SurfaceNet, IsClosedWhereTwoSheetsAreInOneCell) {
  // Two balls whose gap is half a cell.
  const SurfaceNet net = polygonize_field(
      [](const Eigen::Vector3d& p) {
        return std::min((p - Eigen::Vector3d(0.0105, 0.0003, 0)).norm(),
                        (p + Eigen::Vector3d(0.0105, 0, 0)).norm()) -
               0.01;
      },
      {Eigen::Vector3d(-0.03, -0.02, -0.02), Eigen::Vector3d(0.03, 0.02, 0.02)}, 0.002);
  EXPECT_TRUE(is_closed(net.triangles));
}

TEST(SurfaceNet, LeavesOutOnlyWhatDoesNotMatter) {
  const auto torus = [](double slope, int& count) {
    const auto field = [&](const Eigen::Vector3d& p) {
      ++count;
      return slope * (std::hypot(std::hypot(p.x(), p.y()) - 0.02, p.z()) - 0.006);
    };
    return polygonize_field(field, {Eigen::Vector3d(-0.03, -0.03, -0.02), Eigen::Vector3d(0.05, 0.04, 0.04)},
                            0.002);
  };
  int some = 0, all = 0;
  const SurfaceNet net = torus(1, some), plain = torus(0x1p-40, all);  // nothing lies far off, the rest is equal
  EXPECT_EQ(net.vertices, plain.vertices);
  EXPECT_EQ(net.triangles, plain.triangles);
  EXPECT_LT(some, all / 3);
}

TEST(SurfaceNet, RefusesABoxThatCutsTheSurface) {
  EXPECT_THROW(polygonize_field([](const Eigen::Vector3d& p) { return p.norm() - 0.02; },
                                {Eigen::Vector3d(-0.01, -0.03, -0.03), Eigen::Vector3d(0.03, 0.03, 0.03)}, 0.002),
               std::logic_error);
}

TEST(SurfaceNet, AnOpenOrDoubledEdgeIsNotClosed) {
  std::vector<std::array<uint32_t, 3>> tetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  EXPECT_TRUE(is_closed(tetrahedron));
  std::vector<std::array<uint32_t, 3>> open(tetrahedron.begin(), tetrahedron.begin() + 3);
  EXPECT_FALSE(is_closed(open));
  tetrahedron.push_back({0, 2, 1});
  EXPECT_FALSE(is_closed(tetrahedron));
}

}  // namespace
}  // namespace glovebench::render
