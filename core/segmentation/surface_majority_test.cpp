#include "core/segmentation/surface_majority.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace glovebench {
namespace {

struct Scene {
  LabelImage labels{9, 7};
  DepthImage depth{9, 7, 0.7F};
};

/// Patch 3 at the left, 5 at the right.
Scene two_patches() {
  Scene scene;
  for (int v = 0; v < 7; ++v)
    for (int u = 0; u < 9; ++u) scene.labels(u, v) = u < 4 ? 3 : 5;
  return scene;
}

TEST(SurfaceMajority, closes_the_gap_between_two_patches) {
  Scene scene = two_patches();
  const LabelImage whole = scene.labels;
  for (int v = 0; v < 7; ++v) scene.labels(4, v) = 0;  // what mixes 3 and 5
  const LabelImage filtered = surface_majority(scene.labels, scene.depth);
  for (int v = 0; v < 7; ++v) {
    EXPECT_EQ(filtered(4, v), 3) << "three votes each: the smaller label";
    EXPECT_EQ(filtered(3, v), 3);
    EXPECT_EQ(filtered(5, v), 5);
  }
  for (int v = 0; v < 7; ++v) scene.labels(4, v) = 7;  // or is taken for a third color
  scene.labels(4, 3) = 5;
  EXPECT_EQ(surface_majority(scene.labels, scene.depth)(4, 3), 5);
  EXPECT_EQ(surface_majority(whole, scene.depth), whole) << "nothing to mend";
}

TEST(SurfaceMajority, stays_on_the_surface) {
  Scene scene = two_patches();
  for (int v = 0; v < 7; ++v) scene.depth(4, v) = 0.75F;  // behind both
  for (int v = 0; v < 7; ++v) scene.labels(4, v) = 0;
  EXPECT_EQ(surface_majority(scene.labels, scene.depth), scene.labels);
  for (int v = 0; v < 7; ++v) scene.depth(4, v) = 0;  // without a depth there is no point
  EXPECT_EQ(surface_majority(scene.labels, scene.depth), scene.labels);
  EXPECT_EQ(surface_majority(scene.labels, scene.depth, 1.0)(3, 3), 3);
}

TEST(SurfaceMajority, removes_a_speck_within_a_patch_and_grows_none_from_one_alone) {
  Scene scene = two_patches();
  scene.labels(2, 3) = 8;
  EXPECT_EQ(surface_majority(scene.labels, scene.depth)(2, 3), 3);
  Scene empty;
  empty.labels(4, 3) = 8;
  EXPECT_EQ(surface_majority(empty.labels, empty.depth), empty.labels);
  empty.labels(4, 4) = 8;
  EXPECT_EQ(surface_majority(empty.labels, empty.depth)(3, 3), 8) << "two vote";
  EXPECT_EQ(surface_majority(LabelImage(), DepthImage()).size(), 0U);
}

TEST(SurfaceMajority, never_takes_a_label_away_and_never_one_that_is_not_near) {
  RandomStream random(4, "surface majority", 0, "labels");
  LabelImage labels(40, 30);
  DepthImage depth(40, 30);
  for (uint8_t& label : labels) label = static_cast<uint8_t>(random.index(4));
  for (float& z : depth) z = 0.7F + 0.05F * static_cast<float>(random.index(2));
  const LabelImage filtered = surface_majority(labels, depth);
  for (int v = 0; v < labels.height(); ++v)
    for (int u = 0; u < labels.width(); ++u) {
      EXPECT_TRUE(labels(u, v) == 0 || filtered(u, v) != 0);
      bool near = filtered(u, v) == 0;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
          near |= labels.contains(u + i, v + j) && labels(u + i, v + j) == filtered(u, v) &&
                  std::abs(depth(u + i, v + j) - depth(u, v)) < 0.02F;
      EXPECT_TRUE(near);
    }
}

}  // namespace
}  // namespace glovebench
