#include "core/cloud/labeled_cloud.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/base/random.h"

namespace glovebench {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const PinholeCamera kSmallCamera{.width = 8, .height = 6, .fx = 10, .fy = 20, .cx = 3, .cy = 2};

/// All glove (label 1) at 0.7 m where `picture` has a letter 'n', at 0.8 m where it has an 'f'.
LabeledCloud cloud_of(const std::vector<std::string>& picture) {
  const int width = static_cast<int>(picture[0].size()), height = static_cast<int>(picture.size());
  DepthImage depth(width, height, 1.0f);
  LabelImage labels(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      labels(u, v) = picture[v][u] != '.';
      depth(u, v) = picture[v][u] == 'f' ? 0.8f : 0.7f;
    }
  return build_cloud(depth, labels, kSmallCamera, {});
}

TEST(Cloud, HoldsGlovePixelsInTheVolumeInRowMajorOrder) {
  DepthImage depth(8, 6);
  LabelImage labels(8, 6);
  labels(5, 1) = 3, depth(5, 1) = 0.5f;
  labels(1, 4) = 9, depth(1, 4) = 0.6f;
  labels(0, 0) = 2;                      // no depth
  labels(2, 0) = 2, depth(2, 0) = 0.3f;  // too near
  labels(3, 0) = 2, depth(3, 0) = 1.1f;  // too far
  labels(4, 0) = 2, depth(4, 0) = std::numeric_limits<float>::quiet_NaN();
  depth(7, 5) = 0.5f;  // not glove
  const LabeledCloud cloud = build_cloud(depth, labels, kSmallCamera, {.z_min = 0.4, .z_max = 1.0});
  ASSERT_EQ(cloud.points.size(), 2u);
  // ((5 - 3) / 10 * 0.5, (1 - 2) / 20 * 0.5, 0.5) and ((1 - 3) / 10 * 0.6, (4 - 2) / 20 * 0.6, 0.6); single
  // precision.
  EXPECT_TRUE(cloud.points[0].p.isApprox(Eigen::Vector3f(0.1f, -0.025f, 0.5f), 1e-6f));
  EXPECT_TRUE(cloud.points[1].p.isApprox(Eigen::Vector3f(-0.12f, 0.06f, 0.6f), 1e-6f));
  EXPECT_EQ(cloud.points[0].label, 3);
  EXPECT_EQ(cloud.points[1].label, 9);
  EXPECT_EQ(cloud.labeled_outside, 2);
  LabelImage expected(8, 6);
  expected(5, 1) = 3, expected(1, 4) = 9;
  EXPECT_EQ(cloud.labels, expected);
}

TEST(Components, AreEightConnected) {
  EXPECT_THAT(component_sizes(cloud_of({"nn......",  //
                                        "..n...n.",  //
                                        ".......n",  //
                                        "nnnn...."}),
                              0.05),
              ElementsAre(4, 3, 2));
}

TEST(Components, JoinBranchesThatMeetLater) {
  EXPECT_THAT(component_sizes(cloud_of({"n.n.n",  //
                                        "n.n.n",  //
                                        "nnn.n",  //
                                        "....n",  //
                                        "nnnnn"}),
                              0.05),
              ElementsAre(9, 7));
}

TEST(Components, BreakAtDepthSteps) {
  const LabeledCloud cloud = cloud_of({"nnnff",  //
                                       "nnnff"});
  EXPECT_THAT(component_sizes(cloud, 0.05), ElementsAre(6, 4));
  EXPECT_THAT(component_sizes(cloud, 0.15), ElementsAre(10));
}

TEST(Components, OfAnEmptyCloudAreNone) {
  const LabeledCloud empty = cloud_of({"....", "...."});
  EXPECT_THAT(component_sizes(empty, 0.05), IsEmpty());
  EXPECT_TRUE(largest_component(empty, 0.05).points.empty());
}

/// Sizes by flood fill, the plain way.
RecycledVector<int> flood_fill_sizes(LabelImage labels, const DepthImage& depth, double depth_step) {
  RecycledVector<int> sizes;
  for (int v = 0; v < labels.height(); ++v)
    for (int u = 0; u < labels.width(); ++u) {
      if (labels(u, v) == 0) continue;
      std::vector<std::pair<int, int>> open = {{u, v}};
      labels(u, v) = 0;
      int size = 0;
      while (!open.empty()) {
        const auto [i, j] = open.back();
        open.pop_back();
        ++size;
        for (int dj = -1; dj <= 1; ++dj)
          for (int di = -1; di <= 1; ++di)
            if (labels.contains(i + di, j + dj) && labels(i + di, j + dj) != 0 &&
                std::abs(depth(i + di, j + dj) - depth(i, j)) <= depth_step) {
              labels(i + di, j + dj) = 0;
              open.emplace_back(i + di, j + dj);
            }
      }
      sizes.push_back(size);
    }
  std::sort(sizes.rbegin(), sizes.rend());
  return sizes;
}

TEST(Components, AgreeWithFloodFillOnRandomImages) {
  RandomStream random(11, "components", 0, "image");
  for (double density : {0.2, 0.45, 0.7}) {
    DepthImage depth(61, 47);
    LabelImage labels(61, 47);
    for (size_t i = 0; i < labels.size(); ++i) {
      labels[i] = static_cast<uint8_t>(random.uniform() < density ? 1 + random.index(10) : 0);
      depth[i] = random.uniform() < 0.6 ? 0.5f : 0.75f;
    }
    const PinholeCamera camera{.width = 61, .height = 47, .fx = 100, .fy = 100, .cx = 30, .cy = 23};
    const LabeledCloud cloud = build_cloud(depth, labels, camera, {});
    EXPECT_EQ(component_sizes(cloud, 0.05), flood_fill_sizes(labels, depth, 0.05)) << density;
  }
}

TEST(LargestComponent, KeepsPointsLabelsAndCountsTogether) {
  LabeledCloud cloud = cloud_of({"nn..fff",  //
                                 "nn..fff"});
  cloud.labeled_outside = 3;
  const LabeledCloud kept = largest_component(cloud, 0.05);
  ASSERT_EQ(kept.points.size(), 6u);
  for (const LabeledPoint& point : kept.points) EXPECT_EQ(point.p.z(), 0.8f);
  EXPECT_EQ(std::count(kept.labels.begin(), kept.labels.end(), 1), 6);
  EXPECT_EQ(kept.labels(0, 0), 0);
  EXPECT_EQ(kept.labels(4, 0), 1);
  EXPECT_EQ(kept.labeled_outside, 3);
}

TEST(LabeledCloud, CountsWhatReachesOutOfTheVolume) {
  const WorkingVolume volume{0.4, 0.9};
  DepthImage depth(6, 1);
  LabelImage labels(6, 1, 3);
  const float z[] = {0.30f, 0.36f, 0.41f, 0.89f, 0.94f, 1.20f};
  std::copy(std::begin(z), std::end(z), depth.begin());
  const PinholeCamera camera{6, 1, 100, 100, 2.5, 0};
  const LabeledCloud cloud = build_cloud(depth, labels, camera, volume);
  EXPECT_EQ(cloud.points.size(), 2u);
  EXPECT_EQ(cloud.labeled_outside, 4);
  EXPECT_EQ(cloud.labeled_cut_off, 2);  // within 50 mm of an end
  EXPECT_EQ(largest_component(cloud, 0.05).labeled_cut_off, 2);
}

}  // namespace
}  // namespace glovebench
