#include "core/pose/articulated_step.h"

#include <gtest/gtest.h>

#include "core/base/math.h"
#include "core/pose/test_alignment.h"

namespace glovebench {
namespace {

/// Pulls on every tenth vertex in random directions, as far as this step moves it.
NormalEquations pulls_of(const StepVector& step, const PosedHand& hand) {
  const std::array<Screw, kAngleCount> screws = angle_screws(test_hand(), hand);
  const std::vector<BodyShares> shares = body_shares(test_hand());
  PlainPullSums sums(screws);
  RandomStream random(1, "articulated step", 0, "directions");
  for (size_t v = 0; v < hand.vertices.size(); v += 10) {
    const Eigen::Vector3d q = hand.vertices[v].cast<double>();
    const double degree = radians_from_degrees(1.0);
    Eigen::Vector3d motion = degree * Eigen::Vector3d(step.head<3>()).cross(q) + step.segment<3>(3) / 1000;
    for (int a = 0; a < kAngleCount; ++a)
      motion += degree * step[6 + a] * static_cast<double>(angle_shares(shares[v])[a]) *
                (screws[a].axis.cross(q) + screws[a].moment);
    const Eigen::Vector3d direction = random_direction(random);
    sums.add({q, direction, 1000 * direction.dot(motion), random.uniform(0.5, 2)}, shares[v]);
  }
  return sums.equations();
}

StepVector some_step(double size) {
  RandomStream random(1, "articulated step", 0, "step");
  StepVector step;
  for (double& value : step) value = random.uniform(-size, size);
  return step;
}

TEST(ArticulatedStep, is_recovered_from_what_it_moves) {
  const StepVector step = some_step(3);
  const StepVector solved = solve_within_limits(pulls_of(step, posed()), Posture::Constant(0.3)).value();
  EXPECT_LT((solved - step).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ArticulatedStep, of_the_pose_alone_keeps_the_angles) {
  StepVector step = some_step(3);
  step.tail<kAngleCount>().setZero();
  const StepVector solved = solve_within_limits(pulls_of(step, posed()), Posture::Constant(0.3), true).value();
  EXPECT_LT((solved - step).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(solved.tail<kAngleCount>().norm(), 0);
}

TEST(ArticulatedStep, ends_at_a_limit_and_the_others_do_their_best) {
  StepVector step = some_step(1);
  Posture posture = Posture::Constant(0.3);
  const double limit_deg = angle_infos()[kIndexPipFlexion].max_deg;
  posture[kIndexPipFlexion] = radians_from_degrees(limit_deg - 2);
  step[6 + kIndexPipFlexion] = 10;
  const NormalEquations equations = pulls_of(step, posed());
  const StepVector solved = solve_within_limits(equations, posture).value();
  EXPECT_NEAR(solved[6 + kIndexPipFlexion], 2, 1e-9);
  const ArticulatedPose end = moved({posture, Eigen::Isometry3d::Identity()}, solved);
  EXPECT_EQ(end.posture, clamp_to_limits(end.posture));
  // No other angle can do better: the gradient is zero but for the angle at its limit.
  StepVector gradient = equations.H * solved - equations.g;
  EXPECT_LT(gradient[6 + kIndexPipFlexion], 0);
  gradient[6 + kIndexPipFlexion] = 0;
  EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-6 * equations.g.cwiseAbs().maxCoeff());
}

TEST(ArticulatedStep, holds_an_angle) {
  StepVector step = StepVector::Zero();
  NormalEquations equations = pulls_of(step, posed());
  equations.hold(kIndexPipFlexion, 5, 1e6);
  EXPECT_NEAR(solve_within_limits(equations, Posture::Constant(0.3)).value()[6 + kIndexPipFlexion], 5, 0.01);
}

TEST(ArticulatedStep, is_none_where_the_equations_leave_a_motion_open) {
  PlainPullSums sums(angle_screws(test_hand(), posed()));
  sums.add({{0.1, 0, 0}, {0, 1, 0}, 5, 1}, BodyShares{1});
  EXPECT_FALSE(solve_within_limits(sums.equations(), Posture::Zero()));
}

TEST(ArticulatedStep, moves_the_hand_as_its_equations_say) {
  const ArticulatedPose pose{Posture::Constant(0.3), test_pose({0.02, 0.03, 0.7})};
  const StepVector step = 0.01 * some_step(1);
  const ArticulatedPose end = moved(pose, step);
  EXPECT_LT(
      (pose.T_camera_hand.inverse() * end.T_camera_hand).translation().norm() * 1000 - step.segment<3>(3).norm(),
      1e-9);
  EXPECT_NEAR(angle_deg(pose.T_camera_hand, end.T_camera_hand), step.head<3>().norm(), 1e-6);
  for (int a = 0; a < kAngleCount; ++a)
    EXPECT_NEAR(degrees_from_radians(end.posture[a] - pose.posture[a]), step[6 + a], 1e-9);
}

Posture random_posture(int number) {
  RandomStream random(1, "articulated step", number, "posture");
  Posture posture;
  for (int a = 0; a < kAngleCount; ++a)
    posture[a] = radians_from_degrees(random.uniform(angle_infos()[a].min_deg, angle_infos()[a].max_deg));
  return posture;
}
RecycledVector<BonePair> overlaps_of(const Posture& posture) {
  return overlapping_bones(test_hand().pose(posture).T_hand_joint, kBonesMayOverlap);
}
/// The overlap of the same bones at the same place in a posture close by, mm.
std::optional<double> overlap_mm(const Posture& posture, const BonePair& pair) {
  for (const BonePair& other : overlaps_of(posture))
    if (other.angles == pair.angles && other.fingers == pair.fingers &&
        (other.nearest[0] - pair.nearest[0]).norm() < 0.001)
      return 1000 * other.overlap;
  return {};
}

TEST(Bones, part_along_the_change_of_their_distance) {
  constexpr double kWeight = 3, kStep_deg = 0.01;
  int compared = 0;
  for (int number = 0; number < 40; ++number) {
    const Posture posture = random_posture(number);
    for (const BonePair& pair : overlaps_of(posture)) {
      const double excess_mm = 1000 * (pair.overlap - may_overlap(pair));
      NormalEquations equations;
      push_apart(equations, angle_screws(test_hand(), test_hand().pose(posture)), pair, kWeight);
      EXPECT_EQ(equations.H.isZero(0), excess_mm <= 0);
      if (excess_mm < 0.1) continue;  // no step ends the overlap
      const StepVector row = equations.g / (kWeight * excess_mm);
      EXPECT_TRUE(equations.H.isApprox(kWeight * row * row.transpose()));
      EXPECT_LT(row.head<6>().norm(), 1e-9) << "the hand stays where it is";
      for (int a = 0; a < kAngleCount; ++a) {
        Posture less = posture, more = posture;
        less[a] -= radians_from_degrees(kStep_deg / 2);
        more[a] += radians_from_degrees(kStep_deg / 2);
        const auto before = overlap_mm(less, pair), after = overlap_mm(more, pair);
        ASSERT_TRUE(before && after);
        EXPECT_NEAR(row[6 + a], (*before - *after) / kStep_deg, 0.002) << "posture " << number << ", angle " << a;
      }
      ++compared;
    }
  }
  EXPECT_GT(compared, 40);
}

TEST(Bones, end_apart) {
  EXPECT_TRUE(overlaps_of(Posture::Zero()).empty());
  for (int number = 0; number < 40; ++number) {
    ArticulatedPose pose{random_posture(number), Eigen::Isometry3d::Identity()};
    for (int step = 0; step < 20; ++step) {
      NormalEquations equations;
      equations.H.diagonal().setConstant(0.1);
      const PosedHand hand = test_hand().pose(pose.posture);
      for (const BonePair& pair : overlaps_of(pose.posture))
        push_apart(equations, angle_screws(test_hand(), hand), pair, 5);
      pose = moved(pose, solve_within_limits(equations, pose.posture).value());
    }
    for (const BonePair& pair : overlaps_of(pose.posture))
      EXPECT_LT(pair.overlap, may_overlap(pair) + 0.001) << number;
  }
}

}  // namespace
}  // namespace glovebench
