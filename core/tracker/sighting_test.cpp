#include "core/tracker/sighting.h"

#include <gtest/gtest.h>

#include "core/kinect/disparity.h"
#include "core/tracker/test_scene.h"

namespace glovebench {
namespace {

using render::test_pose;

Sighting seen(const DeviceFrame& frame, const TrackerConfig& config = {}) {
  return see(frame, synthetic_calibration(), test_color_table(), config);
}
Sighting seen_in_reach(const DeviceFrame& frame, const TrackerConfig& config = {}) {
  return see_in_reach(frame, synthetic_calibration(), test_color_table(), config, unobserved);
}

/// What lies beyond reach changes neither the cloud nor the status.
void expect_alike(const DeviceFrame& frame, const TrackerConfig& config = {}) {
  const Sighting all = seen(frame, config), near = seen_in_reach(frame, config);
  EXPECT_EQ(near.status, all.status);
  EXPECT_EQ(near.cloud.labels, all.cloud.labels);
  EXPECT_EQ(near.cloud.labeled_cut_off, all.cloud.labeled_cut_off);
  ASSERT_EQ(near.cloud.points.size(), all.cloud.points.size());
  for (size_t i = 0; i < all.cloud.points.size(); ++i) {
    ASSERT_EQ(near.cloud.points[i].p, all.cloud.points[i].p);
    ASSERT_EQ(near.cloud.points[i].label, all.cloud.points[i].label);
  }
}

/// Nor what the fit of pose and posture is given.
void expect_the_same_view(const DeviceFrame& frame, const TrackerConfig& config) {
  const Sighting all = seen(frame, config), near = seen_in_reach(frame, config);
  ASSERT_EQ(all.status, TrackStatus::tracked);
  HandView of_all, of_near;
  of_all.assign(all, frame, config.volume);
  of_near.assign(near, frame, config.volume);
  ASSERT_EQ(of_near.points.size(), of_all.points.size());
  for (size_t i = 0; i < of_all.points.size(); ++i) ASSERT_EQ(of_near.points[i].p, of_all.points[i].p);
  for (int v = 0; v < all.depth.height(); v += 3)
    for (int u = 0; u < all.depth.width(); u += 3)
      ASSERT_EQ(of_near.mask.way_back_px({u, v}), of_all.mask.way_back_px({u, v})) << u << ", " << v;
}

TEST(Sighting, within_reach_shows_the_same_hand) {
  for (const double z : {0.30, 0.38, 0.45, 0.7, 0.9, 0.94, 0.97, 1.0, 1.03}) {
    for (const double tilt : {0.0, 0.7}) {
      SCOPED_TRACE(testing::Message() << "z " << z << ", tilt " << tilt);
      expect_alike(shoot(test_pose({0.02, 0.03, z}, {tilt, 0.2, 0.3})).frame);
    }
  }
  for (const Eigen::Vector3d& aside : {Eigen::Vector3d(0.6, 0, 0.6), Eigen::Vector3d(0.3, 0.1, 0.6)})
    expect_alike(shoot(test_pose(aside)).frame);
}

TEST(Sighting, within_reach_leaves_the_far_scene_out) {
  const DeviceFrame frame = shoot(test_pose({0.02, 0.03, 0.7})).frame;
  const Sighting all = seen(frame), near = seen_in_reach(frame);
  const auto measured = [](const Sighting& s) {
    return std::ranges::count_if(s.depth, [](float z) { return z > 0; });
  };
  EXPECT_LT(measured(near), measured(all) / 3);
  TrackerConfig filtered;
  filtered.segmentation.surface_majority = true;
  EXPECT_LT(measured(seen_in_reach(frame, filtered)), measured(all) / 3);
  EXPECT_EQ(seen_in_reach(shoot(test_pose({0.6, 0, 0.6})).frame).depth,
            seen(shoot(test_pose({0.6, 0, 0.6})).frame).depth)
      << "without a hand everything counts";
}

TEST(Sighting, within_reach_keeps_what_hides_the_hand) {
  // A gray board before the volume hides a part of the hand from the RGB camera more than from the IR camera.
  DeviceFrame frame = shoot(test_pose({0.02, 0.03, 0.7})).frame;
  const uint16_t board = disparity_from_depth(0.33);
  for (int v = 0; v < frame.raw_disparity.height(); ++v)
    for (int u = 250; u < 320; ++u) frame.raw_disparity(u, v) = board;
  expect_alike(frame);
}

TEST(Sighting, of_measured_depth_is_that_of_disparity) {
  const DeviceFrame raw = shoot(test_pose({0.02, 0.03, 0.7})).frame;
  DeviceFrame measured = {.raw_disparity = {}, .color = raw.color};
  measured.depth = depth_of(raw, {});
  EXPECT_EQ(seen(measured).depth, seen(raw).depth);
  EXPECT_EQ(seen_in_reach(measured).depth, seen_in_reach(raw).depth);
  EXPECT_EQ(seen_in_reach(measured).labels, seen_in_reach(raw).labels);
}

TEST(Sighting, within_reach_heeds_the_filters) {
  TrackerConfig config;
  config.segmentation.majority_filter = true;
  // A hand across the border of what is left out.
  for (const double z : {0.9, 0.94, 0.95, 0.96, 0.97, 0.98})
    expect_alike(shoot(test_pose({0.02, 0.03, z}, {0.7, 0.2, 0.3})).frame, config);
  config.segmentation.majority_filter = false;
  config.segmentation.surface_majority = true;
  for (const double z : {0.9, 0.95, 0.98})
    expect_alike(shoot(test_pose({0.02, 0.03, z}, {0.7, 0.2, 0.3})).frame, config);
  for (const double z : {0.7, 0.9, 0.92})
    expect_the_same_view(shoot(test_pose({0.02, 0.03, z}, {0.7, 0.2, 0.3})).frame, config);
  config.segmentation.surface_majority = false;
  config.segmentation.largest_component = true;
  expect_alike(shoot(test_pose({0.02, 0.03, 0.9})).frame, config);
}

TEST(Sighting, with_the_surface_majority_keeps_every_label_and_closes_gaps) {
  const DeviceFrame frame = shoot(test_pose({0.02, 0.03, 0.7})).frame;
  TrackerConfig config;
  const Sighting plain = seen(frame, config);
  config.segmentation.surface_majority = true;
  const Sighting filtered = seen(frame, config);
  EXPECT_GE(filtered.cloud.points.size(), plain.cloud.points.size());
  EXPECT_NE(filtered.labels, plain.labels);
}

}  // namespace
}  // namespace glovebench
