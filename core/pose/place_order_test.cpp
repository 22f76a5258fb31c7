#include "core/pose/place_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/base/random.h"

namespace glovebench {
namespace {

std::vector<LabeledPoint> random_points(int count) {
  RandomStream random(1, "place order", 0, "points");
  std::vector<LabeledPoint> points;
  for (int i = 0; i < count; ++i) {
    const auto uniform = [&] { return static_cast<float>(random.uniform(-0.1, 0.1)); };
    points.push_back({{uniform(), uniform(), uniform()}, static_cast<uint8_t>(random.index(kColorCount + 1))});
  }
  return points;
}

std::vector<uint32_t> order_of(std::span<const LabeledPoint> points) {
  PlaceOrder order;
  const std::span<const uint32_t> found = order(points);
  return {found.begin(), found.end()};
}

std::vector<uint32_t> all_indices(size_t count) {
  std::vector<uint32_t> indices(count);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

TEST(PlaceOrder, lists_each_point_once_and_labels_together) {
  const std::vector<LabeledPoint> points = random_points(3000);
  std::vector<uint32_t> order = order_of(points);
  EXPECT_TRUE(std::ranges::is_sorted(order, {}, [&](uint32_t i) { return points[i].label; }));
  std::ranges::sort(order);
  EXPECT_EQ(order, all_indices(points.size()));
}

TEST(PlaceOrder, points_that_come_together_lie_together) {
  std::vector<LabeledPoint> points = random_points(3000);
  for (LabeledPoint& point : points) point.label = 1;
  const auto mean_step = [&](const std::vector<uint32_t>& order) {
    double sum = 0;
    for (size_t i = 1; i < order.size(); ++i) sum += (points[order[i]].p - points[order[i - 1]].p).norm();
    return sum / static_cast<double>(order.size() - 1);
  };
  // 0.2 m to the power of three has a cube of 14 mm for each point; two random points are 0.13 m apart.
  EXPECT_LT(mean_step(order_of(points)), 0.02);
  EXPECT_GT(mean_step(all_indices(points.size())), 0.12);
}

TEST(PlaceOrder, follows_the_curve_along_an_axis) {
  const std::vector<LabeledPoint> points = {
      {{0.3f, 0, 0}, 2}, {{0.1f, 0, 0}, 2}, {{0.2f, 0, 0}, 2}, {{0.4f, 0, 0}, 1}};
  EXPECT_EQ(order_of(points), (std::vector<uint32_t>{3, 1, 2, 0}));
}

TEST(PlaceOrder, takes_what_is_not_finite_and_nothing_at_all) {
  std::vector<LabeledPoint> points = random_points(100);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  const float values[] = {kNan, kInf, -kInf, 1e30f};
  for (size_t i = 0; i < 20; ++i) points[5 * i].p[i % 3] = values[i % 4];
  std::vector<uint32_t> order = order_of(points);
  std::ranges::sort(order);
  EXPECT_EQ(order, all_indices(points.size()));
  EXPECT_TRUE(order_of({}).empty());
}

}  // namespace
}  // namespace glovebench
