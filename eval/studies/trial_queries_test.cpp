#include "eval/studies/trial_queries.h"

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/database/test_database.h"
#include "eval/test_program.h"

namespace glovebench::eval {
namespace {

constexpr std::array<int, 2> kSizes = {8, 64};

TEST(TrialHand, lies_between_two_postures_in_the_box) {
  const Posture power = power_posture();
  double share_sum = 0, spread_sum = 0;
  Eigen::Vector3d axis_sum = Eigen::Vector3d::Zero();
  constexpr int kHands = 2000;
  for (int i = 0; i < kHands; ++i) {
    RandomStream random(1, "trial hand test", i, "hand");
    const HandFrame hand = draw_trial_hand(test_postures(), random);
    EXPECT_TRUE(clamp_to_limits(hand.posture) == hand.posture);
    EXPECT_TRUE(hand.T_camera_hand.linear().isUnitary(1e-12));
    const Eigen::Vector3d offset = hand.T_camera_hand.translation() - Eigen::Vector3d(0, 0, kTrialDistance);
    for (int axis = 0; axis < 3; ++axis) EXPECT_LE(std::abs(offset[axis]), kTrialReach[axis]);
    axis_sum += hand.T_camera_hand.linear().col(2);
    const double share = hand.posture.dot(power) / power.squaredNorm();
    share_sum += share;
    spread_sum += (hand.posture - share * power).squaredNorm() / (kAngleCount - 1);
  }
  // Uniform shares of 0..1 have mean 0.5 with deviation 0.29 / sqrt(2000) = 0.0065; noise adds little, limits cut
  // some.
  EXPECT_NEAR(share_sum / kHands, 0.5, 0.03);
  // The distance from the line between the postures is the noise, reduced by the limits.
  const double spread_deg = degrees_from_radians(std::sqrt(spread_sum / kHands));
  EXPECT_LT(spread_deg, 1.05 * kTrialAngleNoise_deg);
  EXPECT_GT(spread_deg, 0.6 * kTrialAngleNoise_deg);
  // No direction is preferred: the mean of uniform directions has a deviation of 1 / sqrt(3 * 2000) = 0.013 per
  // axis.
  EXPECT_LT((axis_sum / kHands).norm(), 0.06);
}

TEST(TrialHand, of_one_posture_stays_near_it) {
  const PostureSet one{"DB_one", {"power"}, {power_posture()}};
  RandomStream random(1, "trial hand test", 0, "hand");
  const HandFrame hand = draw_trial_hand(one, random);
  EXPECT_LT(degrees_from_radians(posture_distance(hand.posture, power_posture())), 2 * kTrialAngleNoise_deg);
}

TEST(TrialQueriesLong, depend_on_the_seed_and_not_on_threads) {
  Workbench one(test_workbench(1)), two(test_workbench(2));
  const auto make = [](Workbench& workbench, uint64_t seed) {
    return make_trial_queries(workbench, profile("paper"), test_postures(), kSizes, seed, 8);
  };
  const std::vector<TrialQuery> a = make(one, 1), b = make(two, 1), other = make(two, 2);
  ASSERT_EQ(a.size(), 8U);
  for (size_t q = 0; q < a.size(); ++q) {
    EXPECT_EQ(a[q].hand.posture, b[q].hand.posture);
    EXPECT_EQ(a[q].images, b[q].images);
    EXPECT_EQ(a[q].redraws, b[q].redraws);
    EXPECT_NE(a[q].hand.posture, other[q].hand.posture);
    ASSERT_EQ(a[q].images.size(), kSizes.size());
    for (size_t s = 0; s < kSizes.size(); ++s) {
      EXPECT_EQ(a[q].images[s].width(), kSizes[s]);
      EXPECT_GT(std::ranges::count_if(a[q].images[s], [](uint8_t label) { return label != 0; }), 0);
    }
  }
}

TEST(TrialQueriesLong, a_hand_that_the_tracker_would_not_look_up_is_not_seen) {
  Workbench workbench(test_workbench());
  TrialCamera camera(workbench, profile("paper"), {});
  HandFrame hand;
  hand.T_camera_hand.translation().z() = kTrialDistance;
  EXPECT_TRUE(camera.see(hand, {1, "trial camera test", 0}).has_value());
  hand.T_camera_hand.translation().x() = 0.38;  // half of the hand is beyond the border
  EXPECT_FALSE(camera.see(hand, {1, "trial camera test", 0}).has_value());
  hand.T_camera_hand.translation() = Eigen::Vector3d(0, 0, 1.2);  // beyond the working volume
  EXPECT_FALSE(camera.see(hand, {1, "trial camera test", 0}).has_value());
}

TEST(TrialQueriesLong, a_tracker_that_looks_up_nothing_is_an_error) {
  Workbench workbench(test_workbench());
  TrackerConfig config = profile("paper");
  config.detection.min_pixels = 640 * 480;
  EXPECT_THAT([&] { make_trial_queries(workbench, config, test_postures(), kSizes, 1, 1); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("none of 100 hands")));
}

}  // namespace
}  // namespace glovebench::eval
