#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/math.h"
#include "core/robot/robot_command.h"
#include "core/test_error.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

using testing::HasSubstr;

// Sums and unit conversions of angles under 180 degrees lose at most a few units in the last place.
constexpr double kLineRounding = 1e-12;

Posture posture_with(std::initializer_list<std::pair<Angle, double>> angles_deg) {
  Posture posture = Posture::Zero();
  for (const auto& [angle, degrees] : angles_deg) posture[angle] = radians_from_degrees(degrees);
  return posture;
}

double actuator_deg(const ShadowHandTargets& targets, std::string_view name) {
  for (int a = 0; a < kShadowActuatorCount; ++a)
    if (shadow_actuator_infos()[a].name == name) return degrees_from_radians(targets.actuators[a]);
  ADD_FAILURE() << "no actuator " << name;
  return 0;
}

double joint_deg(const ShadowHandTargets& targets, ShadowJoint joint) {
  return degrees_from_radians(targets.joints[joint]);
}

TrackResult tracked(int64_t timestamp_us, const Posture& posture) {
  TrackResult result;
  result.timestamp_us = timestamp_us;
  result.status = TrackStatus::tracked;
  result.posture = posture;
  result.T_camera_hand.translation() = Eigen::Vector3d(0.1, 0.2, 0.7);
  return result;
}

TEST(ShadowHand, EveryAngleDrivesOneJointAndTwoJointsHaveNoSource) {
  std::set<int> sources;
  std::vector<std::string_view> without_source;
  for (int j = 0; j < kShadowJointCount; ++j) {
    const ShadowJointInfo& info = shadow_joint_infos()[j];
    if (info.source)
      EXPECT_TRUE(sources.insert(*info.source).second) << info.name;
    else
      without_source.push_back(info.name);
  }
  EXPECT_EQ(sources.size(), static_cast<size_t>(kAngleCount));
  EXPECT_THAT(without_source, testing::ElementsAre("LFJ5", "THJ3"));
}

TEST(ShadowHand, EveryJointHangsOnOneActuator) {
  std::multiset<int> joints;
  for (const ShadowActuatorInfo& info : shadow_actuator_infos()) {
    joints.insert(info.joint);
    if (info.coupled_joint) joints.insert(*info.coupled_joint);
  }
  EXPECT_EQ(joints.size(), static_cast<size_t>(kShadowJointCount));
  for (int j = 0; j < kShadowJointCount; ++j) EXPECT_EQ(joints.count(j), 1u) << shadow_joint_infos()[j].name;
}

TEST(ShadowHand, NamesMatchTheEnumeration) {
  EXPECT_EQ(shadow_joint_infos()[kFFJ1].name, "FFJ1");
  EXPECT_EQ(shadow_joint_infos()[kLFJ5].name, "LFJ5");
  EXPECT_EQ(shadow_joint_infos()[kTHJ1].name, "THJ1");
  EXPECT_EQ(shadow_joint_infos()[kWRJ2].name, "WRJ2");
}

TEST(ShadowHand, MapsAGraspByHand) {
  const ShadowHandTargets targets = map_to_shadow_hand(posture_with({{kIndexMcpFlexion, 40},
                                                                     {kIndexPipFlexion, 60},
                                                                     {kIndexDipFlexion, 30},
                                                                     {kThumbCmcAbduction, 50},
                                                                     {kThumbCmcFlexion, 20},
                                                                     {kThumbMcpFlexion, 10},
                                                                     {kThumbIpFlexion, 35},
                                                                     {kWristFlexion, -25},
                                                                     {kWristAbduction, 5}}));
  EXPECT_NEAR(actuator_deg(targets, "FFJ3"), 40, kLineRounding);
  EXPECT_NEAR(actuator_deg(targets, "FFJ0"), 90, kLineRounding);
  EXPECT_NEAR(joint_deg(targets, kFFJ2), 90, kLineRounding) << "J2 bends first";
  EXPECT_NEAR(joint_deg(targets, kFFJ1), 0, kLineRounding);
  EXPECT_NEAR(actuator_deg(targets, "THJ4"), 50, kLineRounding);
  EXPECT_NEAR(actuator_deg(targets, "THJ5"), 20, kLineRounding);
  EXPECT_NEAR(actuator_deg(targets, "THJ2"), 10, kLineRounding);
  EXPECT_NEAR(actuator_deg(targets, "THJ1"), 35, kLineRounding);
  EXPECT_NEAR(actuator_deg(targets, "WRJ1"), -25, kLineRounding);
  EXPECT_NEAR(actuator_deg(targets, "WRJ2"), 5, kLineRounding);
  EXPECT_EQ(actuator_deg(targets, "THJ3"), 0);
  EXPECT_EQ(actuator_deg(targets, "LFJ5"), 0);
  EXPECT_THAT(targets.joint_clamped, testing::Each(false));
}

TEST(ShadowHand, SpreadFingersAreNegativeJ4) {
  // A spread hand: index and middle turn towards the thumb, ring and little away from it.
  const ShadowHandTargets targets = map_to_shadow_hand(posture_with(
      {{kIndexMcpAbduction, 12}, {kMiddleMcpAbduction, 3}, {kRingMcpAbduction, -8}, {kLittleMcpAbduction, -15}}));
  EXPECT_NEAR(actuator_deg(targets, "FFJ4"), -12, kLineRounding);
  EXPECT_NEAR(actuator_deg(targets, "MFJ4"), -3, kLineRounding);
  EXPECT_NEAR(actuator_deg(targets, "RFJ4"), -8, kLineRounding);
  EXPECT_NEAR(actuator_deg(targets, "LFJ4"), -15, kLineRounding);
}

TEST(ShadowHand, ClampsToTheLimitsAndSaysWhichJoint) {
  const ShadowHandTargets targets = map_to_shadow_hand(posture_with(
      {{kWristFlexion, 45}, {kMiddlePipFlexion, 110}, {kMiddleDipFlexion, 75}, {kRingMcpFlexion, -30}}));
  EXPECT_NEAR(joint_deg(targets, kWRJ1), 28, kLineRounding);
  EXPECT_NEAR(joint_deg(targets, kMFJ2), 90, kLineRounding);
  EXPECT_NEAR(joint_deg(targets, kMFJ1), 90, kLineRounding);
  EXPECT_NEAR(joint_deg(targets, kRFJ3), -15, kLineRounding);
  EXPECT_NEAR(actuator_deg(targets, "MFJ0"), 180, kLineRounding);
  EXPECT_EQ(std::ranges::count(targets.joint_clamped, true), 4);
  EXPECT_TRUE(targets.joint_clamped[kWRJ1] && targets.joint_clamped[kMFJ1] && targets.joint_clamped[kMFJ2] &&
              targets.joint_clamped[kRFJ3]);
  EXPECT_EQ(std::ranges::count(targets.actuator_clamped, true), 3);
}

TEST(ShadowHand, TheMotorKeepsItsSumAndTheCouplingSplitsIt) {
  // PIP, DIP, and J2, J1 by each model, degrees.
  struct Case {
    double pip, dip, series_j2, series_j1, even;
  };
  for (const Case& c : {Case{20, 50, 70, 0, 35}, Case{70, 20, 90, 0, 45}, Case{100, 50, 90, 60, 75},
                        Case{-5, 10, 5, 0, 2.5}, Case{0, 0, 0, 0, 0}}) {
    const Posture posture = posture_with({{kLittlePipFlexion, c.pip}, {kLittleDipFlexion, c.dip}});
    const ShadowHandTargets series = map_to_shadow_hand(posture, ShadowCoupling::series),
                            even = map_to_shadow_hand(posture, ShadowCoupling::even);
    EXPECT_NEAR(joint_deg(series, kLFJ2), c.series_j2, kLineRounding);
    EXPECT_NEAR(joint_deg(series, kLFJ1), c.series_j1, kLineRounding);
    EXPECT_NEAR(joint_deg(even, kLFJ2), c.even, kLineRounding);
    EXPECT_NEAR(joint_deg(even, kLFJ1), c.even, kLineRounding);
    for (const ShadowHandTargets& targets : {series, even}) {
      EXPECT_NEAR(actuator_deg(targets, "LFJ0"), c.pip + c.dip, kLineRounding) << "what the posture asked for";
      EXPECT_THAT(targets.joint_clamped, testing::Each(false));
      EXPECT_THAT(targets.actuator_clamped, testing::Each(false));
    }
  }
}

TEST(RobotCommander, TurnsThePoseIntoTheBaseFrame) {
  // The camera looks straight down from 1 m above the base: its z is the base's -z, its x the base's x.
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
  T_base_camera.linear() = Eigen::Vector3d(1, -1, -1).asDiagonal();
  T_base_camera.translation() = Eigen::Vector3d(0, 0, 1);
  const RobotCommand command = RobotCommander(T_base_camera).command(tracked(5, Posture::Zero()));
  ASSERT_TRUE(command.targets);
  EXPECT_TRUE(command.targets->T_base_hand.translation().isApprox(Eigen::Vector3d(0.1, -0.2, 0.3), kLineRounding));
  EXPECT_TRUE(command.targets->T_base_hand.linear().isApprox(T_base_camera.linear(), kLineRounding));
}

TEST(RobotCommander, LooksDownOnTheWorkByDefault) {
  // 0.7 m below the camera, 10 cm to the right and 20 cm down in the image: nearer to the arm, on its right.
  const Eigen::Vector3d p_base = default_T_base_camera() * Eigen::Vector3d(0.1, 0.2, 0.7);
  EXPECT_TRUE(p_base.isApprox(Eigen::Vector3d(0.7, -0.1, 0.5), 1e-12));
  EXPECT_NEAR(default_T_base_camera().linear().determinant(), 1, 1e-12);
}

TEST(RobotCommander, HoldsTheLastTargetsOfALostFrame) {
  RobotCommander commander(Eigen::Isometry3d::Identity());
  TrackResult lost;
  lost.timestamp_us = 1;
  EXPECT_FALSE(commander.command(lost).targets);
  const RobotCommand first = commander.command(tracked(2, posture_with({{kIndexMcpFlexion, 30}})));
  EXPECT_FALSE(first.hold);
  lost.timestamp_us = 3;
  lost.status = TrackStatus::cut_by_border;
  lost.posture.setConstant(1);
  const RobotCommand held = commander.command(lost);
  EXPECT_TRUE(held.hold);
  EXPECT_EQ(held.status, TrackStatus::cut_by_border);
  EXPECT_EQ(held.timestamp_us, 3);
  ASSERT_TRUE(held.targets);
  EXPECT_EQ(held.targets->hand.joints, first.targets->hand.joints);
}

TEST(RobotCommander, RefusesWhatIsNotARigidTransform) {
  Eigen::Isometry3d mirrored = Eigen::Isometry3d::Identity();
  mirrored.linear()(0, 0) = -1;
  EXPECT_THROW(RobotCommander{mirrored}, Error);
  Eigen::Isometry3d unset = Eigen::Isometry3d::Identity();
  unset.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(RobotCommander{unset}, Error);
}

TEST(RobotCommander, NothingThatIsNotFiniteLeaves) {
  RobotCommander commander(Eigen::Isometry3d::Identity());
  Posture posture = Posture::Zero();
  posture[kRingPipFlexion] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(thrown_by([&] { commander.command(tracked(1, posture)); }), HasSubstr("ring_pip_flexion"));
  RobotCommand command = commander.command(tracked(2, Posture::Zero()));
  command.targets->T_base_hand.translation().y() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(to_json_line(command), Error);
}

TEST(JsonLinesSink, WritesEachLineAsItComesAndKeepsThemWithoutAnEnd) {
  const std::string folder = test_folder();
  RobotCommander commander(Eigen::Isometry3d::Identity());
  const auto bytes_on_disk = [&] {
    uintmax_t bytes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) bytes += entry.file_size();
    return bytes;
  };
  {
    JsonLinesSink sink(folder + "/robot.jsonl");
    uintmax_t before = 0;
    for (int frame = 1; frame <= 3; ++frame) {
      sink.send(commander.command(tracked(frame, Posture::Zero())));
      EXPECT_GT(bytes_on_disk(), before + 500);
      before = bytes_on_disk();
    }
    EXPECT_FALSE(std::filesystem::exists(folder + "/robot.jsonl"));
  }
  EXPECT_FALSE(std::filesystem::exists(folder + "/robot.jsonl")) << "never finished";
  const std::string kept = read_file(folder + "/robot.jsonl.partial");
  EXPECT_EQ(std::count(kept.begin(), kept.end(), '\n'), 3);
}

TEST(JsonLinesSink, WritesOneLineAFrame) {
  const std::string path = test_folder() + "/robot.jsonl";
  RobotCommander commander(Eigen::Isometry3d::Identity());
  JsonLinesSink sink(path);
  TrackResult lost;
  sink.send(commander.command(lost));
  sink.send(
      commander.command(tracked(66667, posture_with({{kIndexMcpAbduction, 30}, {kIndexMcpFlexion, 1.0 / 3}}))));
  EXPECT_FALSE(std::filesystem::exists(path));
  sink.finish();

  std::istringstream lines(read_file(path));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, R"({"frame_timestamp_us":0,"timestamp_us":0,"status":"no_hand","hold":true,"state":"stopped",)"
                  R"("interventions":{},"actuators":null,"joints":null,"base_hand":null,"arm":null})");
  std::getline(lines, line);
  const nlohmann::json json = nlohmann::json::parse(line);
  EXPECT_EQ(json["frame_timestamp_us"], 66667);
  EXPECT_EQ(json["hold"], false);
  EXPECT_EQ(json["actuators"]["target_deg"].size(), 20u);
  EXPECT_EQ(json["joints"]["target_deg"].size(), 24u);
  EXPECT_EQ(json["joints"]["target_deg"]["FFJ4"], -20);
  EXPECT_EQ(json["joints"]["target_deg"]["FFJ3"], 0.333333);
  EXPECT_EQ(json["joints"]["clamped"], nlohmann::json::array({"FFJ4"}));
  EXPECT_EQ(json["base_hand"]["position_m"], nlohmann::json::array({0.1, 0.2, 0.7}));
  EXPECT_EQ(json["base_hand"]["rotation_wxyz"], nlohmann::json::array({1, 0, 0, 0}));
  EXPECT_THAT(line, Not(HasSubstr("-0.0"))) << "minus zero has no place in a command";
  EXPECT_FALSE(std::getline(lines, line));
}

}  // namespace
}  // namespace glovebench
