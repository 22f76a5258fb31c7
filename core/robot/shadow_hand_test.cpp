#include "core/robot/shadow_hand.h"

#include <gmock/gmock.h>

#include <limits>
#include <numbers>

#include "core/base/math.h"
#include "core/base/random.h"

namespace glovebench {
namespace {

using enum ShadowCoupling;

constexpr double kCouplingRounding = 1e-12;

CoupledJoints split_deg(double motor_deg, ShadowCoupling coupling) {
  const CoupledJoints joints = split_motor(radians_from_degrees(motor_deg), coupling);
  return {degrees_from_radians(joints.distal), degrees_from_radians(joints.proximal)};
}

TEST(ShadowCoupling, NamesReturn) {
  EXPECT_THAT(all_names<ShadowCoupling>(), testing::ElementsAre("series", "even"));
  for (const ShadowCoupling coupling : {series, even})
    EXPECT_EQ(from_name<ShadowCoupling>(to_string(coupling)), coupling);
  EXPECT_FALSE(from_name<ShadowCoupling>("Series"));
}

TEST(ShadowCoupling, SplitsByHand) {
  for (const auto& [motor, distal] :
       {std::pair(0.0, 0.0), {40.0, 0.0}, {90.0, 0.0}, {100.0, 10.0}, {180.0, 90.0}}) {
    EXPECT_NEAR(split_deg(motor, series).distal, distal, kCouplingRounding) << motor;
    EXPECT_NEAR(split_deg(motor, series).proximal, motor - distal, kCouplingRounding) << motor;
    EXPECT_NEAR(split_deg(motor, even).distal, motor / 2, kCouplingRounding) << motor;
    EXPECT_NEAR(split_deg(motor, even).proximal, motor / 2, kCouplingRounding) << motor;
  }
}

TEST(ShadowCoupling, SumsToTheMotorBitForBit) {
  // So that what was split is split alike again.
  RandomStream random(1, "coupling", 0, "split");
  std::vector<double> motors;
  for (int i = 1; i < 10; ++i) motors.push_back(i * std::numeric_limits<double>::denorm_min());  // cannot be halved
  for (int i = 0; i < 10'000; ++i) motors.push_back(random.uniform(0, std::numbers::pi));
  for (const double motor : motors) {
    for (const ShadowCoupling coupling : {series, even}) {
      const CoupledJoints joints = split_motor(motor, coupling);
      ASSERT_EQ(joints.distal + joints.proximal, motor);
      ASSERT_LE(joints.distal, joints.proximal);
      ASSERT_LE(joints.proximal, radians_from_degrees(90));
    }
  }
}

TEST(ShadowCoupling, ShareIsTheSlopeOfTheSplit) {
  for (const ShadowCoupling coupling : {series, even})
    for (const double motor : {0.3, 1.2, 2.0, 3.0})
      EXPECT_NEAR((split_motor(motor + 1e-6, coupling).distal - split_motor(motor, coupling).distal) * 1e6,
                  distal_share(motor, coupling), 1e-9);
}

TEST(ShadowCoupling, BetweenTwoStatesTheMotorGoesStraightAndWhatIsOffTheModelFades) {
  RandomStream random(1, "coupling", 0, "between");
  const double right = radians_from_degrees(90);
  for (int i = 0; i < 10'000; ++i) {
    const double proximal = random.uniform(0, right), distal = random.uniform(0, proximal);
    for (const ShadowCoupling coupling : {series, even}) {
      const CoupledJoints from{distal, proximal}, to = split_motor(random.uniform(0, 2 * right), coupling);
      double off = INFINITY;
      for (const double share : {0.0, 0.2, 0.5, 0.9, 1.0}) {
        const CoupledJoints joints = between(from, to, share, coupling);
        const double motor = joints.distal + joints.proximal, start = distal + proximal,
                     end = to.distal + to.proximal;
        ASSERT_NEAR(motor, start + share * (end - start), kCouplingRounding);
        ASSERT_GE(joints.distal, 0);
        ASSERT_LE(joints.distal, joints.proximal);
        ASSERT_LE(joints.proximal, right);
        const double was_off = std::exchange(off, std::abs(joints.distal - split_motor(motor, coupling).distal));
        ASSERT_LE(off, was_off + kCouplingRounding);
        if (share == 0) {
          ASSERT_NEAR(joints.distal, distal, kCouplingRounding);
        }
        if (share == 1) {
          ASSERT_NEAR(joints.distal, to.distal, kCouplingRounding);
        }
      }
    }
  }
}

}  // namespace
}  // namespace glovebench
