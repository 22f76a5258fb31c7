#include "core/pose/hand_mask.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/kinect/disparity.h"

namespace glovebench {
namespace {

struct Scene {
  DepthImage depth{80, 60, 1.5f};
  DeviceFrame frame{Image<uint16_t>(80, 60, 900)};
  std::vector<Eigen::Vector2d> hand_px;

  void put_hand(int u, int v) {
    depth(u, v) = 0.7f;
    hand_px.emplace_back(u, v);
  }
  HandMask mask(const PixelBox& box = {0, 0, 80, 60}) const {
    HandMask made;
    made.assign(depth, frame, box, 0.8f);
    return made;
  }
};

TEST(HandMask, knows_the_nearest_pixel_of_the_hand) {
  Scene scene;
  RandomStream random(1, "hand mask", 0, "pixels");
  for (int i = 0; i < 30; ++i)
    scene.put_hand(static_cast<int>(random.index(80)), static_cast<int>(random.index(60)));
  const HandMask mask = scene.mask();
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < 80; ++u) {
      const Eigen::Vector2d uv(u, v);
      double nearest = 1e9;
      for (const Eigen::Vector2d& px : scene.hand_px) nearest = std::min(nearest, (px - uv).norm());
      const std::optional<Eigen::Vector2d> way = mask.way_back_px(uv);
      if (nearest <= 1) {
        EXPECT_FALSE(way) << u << ", " << v;
        continue;
      }
      ASSERT_TRUE(way) << u << ", " << v;
      const Eigen::Vector2d end = uv + *way;
      EXPECT_FLOAT_EQ(scene.depth(static_cast<int>(end.x()), static_cast<int>(end.y())), 0.7f);
      EXPECT_LT(way->norm(), nearest + 1);  // Danielsson's mapping is a fraction of a pixel off at most
    }
  }
}

TEST(HandMask, takes_a_pixel_without_a_depth_for_one_that_may_be_the_hand) {
  Scene scene;
  scene.frame.raw_disparity(40, 30) = kNoDisparity;
  scene.depth(40, 30) = 0;
  scene.depth(10, 30) = 0;  // too far away to be registered
  const std::optional<Eigen::Vector2d> way = scene.mask().way_back_px({20.5, 30});
  ASSERT_TRUE(way);
  EXPECT_EQ(*way, Eigen::Vector2d(19.5, 0));
}

TEST(HandMask, of_measured_depth_is_that_of_disparity) {
  Scene scene;
  scene.depth(40, 30) = scene.depth(10, 30) = 0;
  scene.frame = {};
  scene.frame.depth = scene.depth;
  scene.frame.depth(10, 30) = 5;  // too far away to be registered
  const std::optional<Eigen::Vector2d> way = scene.mask().way_back_px({20.5, 30});
  ASSERT_TRUE(way);
  EXPECT_EQ(*way, Eigen::Vector2d(19.5, 0));
}

TEST(HandMask, answers_for_places_outside_its_box_from_the_box) {
  Scene scene;
  scene.put_hand(40, 30);
  const std::optional<Eigen::Vector2d> way = scene.mask({30, 20, 50, 40}).way_back_px({5, 30});
  ASSERT_TRUE(way);
  EXPECT_EQ(*way, Eigen::Vector2d(35, 0));
}

TEST(HandMask, without_a_hand_draws_nothing) {
  EXPECT_FALSE(Scene().mask().way_back_px({3, 4}));
  EXPECT_FALSE(Scene().mask(label_box(LabelImage(80, 60), 5)).way_back_px({3, 4}));
}

TEST(HandMask, label_box_lies_around_the_labels_within_the_image) {
  LabelImage labels(80, 60);
  labels(3, 10) = 1;
  labels(50, 20) = 2;
  const PixelBox box = label_box(labels, 5);
  EXPECT_EQ(box.left, 0);
  EXPECT_EQ(box.top, 5);
  EXPECT_EQ(box.right, 56);
  EXPECT_EQ(box.bottom, 26);
}

}  // namespace
}  // namespace glovebench
