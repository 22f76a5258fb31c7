#include "core/hand/hand_motion.h"

#include <gtest/gtest.h>

#include "ci/build_paths.h"
#include "core/base/random.h"

namespace glovebench {
namespace {

/// How far the predicted motion of each vertex is from the difference of two poses, m a radian.
struct Deviation {
  double mean = 0;
  double largest_of_rigid = 0;  ///< of vertices that follow the angle wholly or not at all
};

Deviation deviation(const HandModel& model, const Posture& posture, int angle) {
  constexpr double kTurn = 0.01;
  Posture less = posture, more = posture;
  less[angle] -= kTurn / 2;
  more[angle] += kTurn / 2;
  const PosedHand before = model.pose(less), hand = model.pose(posture), after = model.pose(more);
  const Screw screw = angle_screws(model, hand)[angle];
  const std::vector<BodyShares> shares = body_shares(model);
  Deviation result;
  for (size_t v = 0; v < hand.vertices.size(); ++v) {
    const Eigen::Vector3d q = hand.vertices[v].cast<double>();
    const Eigen::Vector3d moved = (after.vertices[v] - before.vertices[v]).cast<double>() / kTurn;
    const double share = angle_shares(shares[v])[angle];
    const double off = (share * (screw.axis.cross(q) + screw.moment) - moved).norm();
    result.mean += off / static_cast<double>(hand.vertices.size());
    if (share < 1e-6 || share > 1 - 1e-6) result.largest_of_rigid = std::max(result.largest_of_rigid, off);
  }
  return result;
}

Posture some_posture() {
  RandomStream random(1, "hand motion", 0, "posture");
  Posture posture;
  for (int a = 0; a < kAngleCount; ++a) posture[a] = random.uniform(0.1, 0.7);
  return posture;
}

TEST(HandMotion, predicts_how_each_angle_moves_the_surface) {
  for (const Side side : {Side::right, Side::left}) {
    const HandModel model = HandModel::load(build_paths::hand_mesh(), side);
    for (int a = 0; a < kAngleCount; ++a) {
      const Deviation off = deviation(model, some_posture(), a);
      // Vertices are floats: 1e-8 m over a turn of 0.01, and a blended vertex follows its mean joint only nearly.
      EXPECT_LT(off.largest_of_rigid, 1e-5) << angle_infos()[a].name;
      EXPECT_LT(off.mean, 5e-4) << angle_infos()[a].name;
    }
  }
}

TEST(HandMotion, shares_of_the_bodies_sum_to_one) {
  EXPECT_EQ(angles_of_body(0), 0u);
  for (const BodyShares& shares : body_shares(HandModel::load(build_paths::hand_mesh()))) {
    float sum = 0;
    for (const float share : shares) sum += share;
    EXPECT_NEAR(sum, 1, 1e-5);
  }
}

}  // namespace
}  // namespace glovebench
