#include "trajectories/generation/low_dispersion.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "ci/build_paths.h"
#include "core/base/error.h"
#include "core/base/math.h"
#include "core/base/random.h"
#include "trajectories/catalog.h"
#include "trajectories/generation/data_files.h"

namespace glovebench::trajectories {
namespace {

using ::testing::ElementsAre;

const std::string kPostureFolder = build_paths::source("trajectories/data");

/// All angles equal: posture_distance of two such postures is the difference of their values.
Posture all(double angle) { return Posture::Constant(angle); }

TEST(LowDispersion, takes_the_farthest_each_time) {
  const std::vector<Posture> pool = {all(0.1), all(1), all(0.4), all(0.9)};
  EXPECT_THAT(low_dispersion_sample(pool, {all(0)}, 3), ElementsAre(1, 2, 0));
  EXPECT_THAT(low_dispersion_sample({all(1), all(1)}, {all(1)}, 2), ElementsAre(0, 1));
  EXPECT_THROW(low_dispersion_sample(pool, {all(0)}, 5), Error);
  EXPECT_THROW(low_dispersion_sample(pool, {}, 1), Error);
}

TEST(LowDispersion, covering_radius_is_the_worst_nearest_distance) {
  EXPECT_NEAR(covering_radius({all(0), all(0.3), all(1)}, {all(0), all(0.8)}), 0.3, 1e-12);  // rounding only
  EXPECT_THROW(covering_radius({}, {all(0)}), Error);
  EXPECT_THROW(covering_radius({all(0)}, {}), Error);
}

TEST(DatabasePostures, cover_the_pool_better_than_the_median_random_choice) {
  const std::vector<Posture> pool = movement_posture_pool(load_gestures(kPostureFolder));
  const PostureSet twenty = posture_set(kPostureFolder, "DB_20_postures");
  ASSERT_EQ(twenty.postures.size(), kPostureCount20);

  constexpr int choices = 1000;
  const std::vector<Posture> given(twenty.postures.begin(), twenty.postures.begin() + 3);
  std::vector<double> radii;
  for (int c = 0; c < choices; ++c) {
    RandomStream random(1, "low_dispersion_test", c, "choice");
    std::vector<Posture> chosen = given;
    while (chosen.size() < kPostureCount20) chosen.push_back(pool[random.index(pool.size())]);
    radii.push_back(covering_radius(pool, chosen));
  }
  std::ranges::nth_element(radii, radii.begin() + choices / 2);
  const double radius = covering_radius(pool, twenty.postures);
  EXPECT_LT(radius, radii[choices / 2]);
  RecordProperty("radius_deg", std::to_string(degrees_from_radians(radius)));
  RecordProperty("median_random_radius_deg", std::to_string(degrees_from_radians(radii[choices / 2])));
}

TEST(DatabasePostures, are_plausible) {
  for (const std::string& name : posture_set_names()) {
    const PostureSet set = posture_set(kPostureFolder, name);
    for (const Posture& posture : set.postures) {
      EXPECT_EQ(posture.head<2>(), Eigen::Vector2d::Zero());
      for (int pip = kIndexPipFlexion; pip < kAngleCount; pip += 4) {
        // Gestures are in whole degrees.
        EXPECT_NEAR(posture[pip + 1], posture[pip] * 2 / 3, radians_from_degrees(1));
      }
    }
  }
}

TEST(DatabasePostures, differ) {
  const PostureSet twenty = posture_set(kPostureFolder, "DB_20_postures");
  for (size_t i = 0; i < twenty.postures.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      // Farther apart than the few degrees by which a hand varies around one posture.
      EXPECT_GT(posture_distance(twenty.postures[i], twenty.postures[j]), radians_from_degrees(10));
    }
  }
}

}  // namespace
}  // namespace glovebench::trajectories
