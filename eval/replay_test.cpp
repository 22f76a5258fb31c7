#include "eval/replay.h"

#include <gtest/gtest.h>

#include "eval/run_folder.h"
#include "eval/share.h"
#include "eval/test_program.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

TEST(ReplayLong, with_clutter_within_reach_shows_something_else) {
  Workbench workbench(test_workbench());
  Replay plain;
  plain.truth =
      std::make_shared<const trajectories::Trajectory>(trajectories::source_trajectory(trajectory_folder(), "Tr4"));
  plain.databases = {"DB_open_power"};
  plain.range = {40, 1};
  Replay cluttered = plain;
  EXPECT_TRUE(share_images(plain, cluttered));
  EXPECT_EQ(replay_key(workbench, plain), replay_key(workbench, cluttered));
  cluttered.clutter_in_volume = true;
  EXPECT_FALSE(share_images(plain, cluttered));
  EXPECT_NE(replay_key(workbench, plain), replay_key(workbench, cluttered));

  render::SyntheticKinect a = make_kinect(workbench, plain), b = make_kinect(workbench, cluttered);
  a.next_frame();
  b.next_frame();
  const TrackerConfig config = profile("paper");
  const auto pixels_in_volume = [&](const DepthImage& depth) {
    return std::ranges::count_if(depth,
                                 [&](float z) { return z >= config.volume.z_min && z <= config.volume.z_max; });
  };
  EXPECT_GT(pixels_in_volume(b.truth().depth), pixels_in_volume(a.truth().depth) + 1000);
}

}  // namespace
}  // namespace glovebench::eval
