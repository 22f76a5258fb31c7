#include "eval/robot_kinematics.h"

#include <gmock/gmock.h>

#include "ci/build_paths.h"
#include "core/base/math.h"
#include "core/hand/hand_model.h"
#include "core/robot/fingertip_mapping.h"
#include "eval/program.h"
#include "trajectories/catalog.h"
#include "trajectories/posture_file.h"

namespace glovebench::eval {
namespace {

const Skeleton& skeleton() {
  static const Skeleton skeleton = HandModel::load(build_paths::hand_mesh()).skeleton();
  return skeleton;
}
Posture gesture(const char* name) {
  static const PostureSet gestures = trajectories::load_gestures(trajectory_folder());
  return trajectories::find_posture(gestures, name);
}

/// From one posture to another, both included.
std::vector<Posture> between(const Posture& a, const Posture& b, int steps) {
  std::vector<Posture> postures;
  for (int i = 0; i <= steps; ++i) postures.push_back(a + (b - a) * i / steps);
  return postures;
}

MappingErrors direct_errors(const std::vector<Posture>& postures,
                            ShadowCoupling coupling = ShadowCoupling::series) {
  return mapping_errors(skeleton(), postures,
                        [&](const Posture& posture) { return map_to_shadow_hand(posture, coupling); });
}

MappingErrors fingertip_errors(const std::vector<Posture>& postures,
                               ShadowCoupling coupling = ShadowCoupling::series) {
  FingertipMapping mapping(skeleton(), coupling);
  return mapping_errors(skeleton(), postures, [&](const Posture& posture) { return mapping.map(posture); });
}

std::vector<Posture> postures_of(const std::string& trajectory, int between_frames) {
  const auto frames = trajectories::source_trajectory(trajectory_folder(), trajectory).frames;
  std::vector<Posture> postures;
  for (size_t i = 0; i + 1 < frames.size(); ++i)
    for (int k = 0; k < between_frames; ++k)
      postures.push_back(frames[i].posture + (frames[i + 1].posture - frames[i].posture) * k / between_frames);
  return postures;
}

TEST(MappingErrors, CountsByHand) {
  const MappingErrors errors = direct_errors({gesture("open"), gesture("pinch")});
  EXPECT_EQ(errors.postures, 2);
  EXPECT_EQ(errors.pinches, 1);
  EXPECT_EQ(errors.gap_mean, errors.gap_max);
  // The index finger's J2, by PIP and DIP together: 6 + 4 to 48 + 32 degrees.
  EXPECT_NEAR(degrees_from_radians(errors.largest_step), 70, 1e-9);
}

TEST(MappingErrors, EqualAnglesLeaveAPinchOpen) {
  // The README states this difference: with the direct mapping no finger pinches.
  const MappingErrors errors = direct_errors({gesture("pinch")});
  EXPECT_GT(errors.gap_max, 0.04);
  EXPECT_GT(errors.tip_max[0], 0.06);
}

TEST(FingertipMapping, APinchStaysClosed) {
  // Between the pinches of one finger, and at the end of the paths to them. The requirement is 3 mm.
  for (const char* name : {"pinch", "ok"}) {
    for (const char* other : {"pinch", "ok", "open", "relaxed", "spread", "four", "ball", "cylinder", "hook"}) {
      const MappingErrors errors = fingertip_errors(between(gesture(other), gesture(name), 200));
      EXPECT_GT(errors.pinches, 0) << other << " to " << name;
      EXPECT_LT(errors.gap_max, 0.003) << other << " to " << name;
    }
  }
  for (const char* name : {"Tr1", "Tr2"}) {
    const MappingErrors errors = fingertip_errors(postures_of(name, 4));
    EXPECT_GT(errors.pinches, 100) << name;
    EXPECT_LT(errors.gap_max, 0.003) << name;
  }
}

TEST(FingertipMapping, DoesNotJump) {
  // A jump keeps its size with smaller steps between postures; a slope does not.
  for (const ShadowCoupling coupling : {ShadowCoupling::series, ShadowCoupling::even}) {
    for (const std::string& name : trajectories::ground_truth_names()) {
      const MappingErrors fit = fingertip_errors(postures_of(name, 16), coupling),
                          direct = direct_errors(postures_of(name, 16), coupling);
      EXPECT_LT(fit.largest_step, 8 * direct.largest_step) << name << ", " << to_string(coupling);
    }
  }
}

TEST(FingertipMapping, IsTheDirectMappingWhereNothingIsClose) {
  FingertipMapping mapping(skeleton());
  mapping.map(gesture("pinch"));
  const Posture open = gesture("open");
  EXPECT_EQ(mapping.map(open).joints, map_to_shadow_hand(open).joints);
  EXPECT_EQ(mapping.map(open).actuators, map_to_shadow_hand(open).actuators);
}

TEST(FingertipMapping, PlansWithTheCouplingThatItIsTold) {
  FingertipMapping mapping(skeleton(), ShadowCoupling::even);
  const std::vector<Posture> postures = between(gesture("open"), gesture("pinch"), 50);
  const MappingErrors errors =
      mapping_errors(skeleton(), postures, [&](const Posture& posture) { return mapping.map(posture); });
  EXPECT_LT(errors.gap_max, 0.003);
  const ShadowHandTargets pinch = mapping.map(gesture("pinch"));
  for (const ShadowJoint j1 : {kFFJ1, kMFJ1, kRFJ1, kLFJ1}) EXPECT_EQ(pinch.joints[j1], pinch.joints[j1 + 1]);
}

TEST(FingertipMapping, StaysWithinTheLimits) {
  FingertipMapping mapping(skeleton());
  for (const std::string& name : trajectories::ground_truth_names()) {
    for (const Posture& posture : postures_of(name, 2)) {
      const ShadowHandTargets targets = mapping.map(posture);
      for (int j = 0; j < kShadowJointCount; ++j) {
        const ShadowJointInfo& info = shadow_joint_infos()[j];
        ASSERT_GE(targets.joints[j], radians_from_degrees(info.min_deg)) << info.name;
        ASSERT_LE(targets.joints[j], radians_from_degrees(info.max_deg)) << info.name;
      }
      for (int a = 0; a < kShadowActuatorCount; ++a) {
        const ShadowActuatorInfo& info = shadow_actuator_infos()[a];
        if (!info.coupled_joint) continue;
        ASSERT_LE(targets.joints[*info.coupled_joint], targets.joints[info.joint]) << info.name;
        ASSERT_EQ(targets.actuators[a], targets.joints[info.joint] + targets.joints[*info.coupled_joint]);
        ASSERT_EQ(targets.joints[*info.coupled_joint],
                  std::max(0.0, targets.actuators[a] - radians_from_degrees(90)))
            << "J2 bends first";
      }
    }
  }
}

}  // namespace
}  // namespace glovebench::eval
