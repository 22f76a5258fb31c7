#include <gmock/gmock.h>

#include "core/adapters/kdl/make_arm_solver.h"
#include "core/base/math.h"
#include "core/robot/command_guard.h"
#include "eval/program.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

struct ArmMotion {
  int frames = 0, unreachable = 0;
  int too_fast = 0;         ///< targets farther from the last one than a joint may move
  int slowed = 0;           ///< commands that the guard slowed down, also while catching up
  double largest_wish = 0;  ///< largest step of a joint's target between frames, rad
};

bool is_too_fast(const RobotCommand& from, const RobotCommand& to) {
  const double seconds = static_cast<double>(to.timestamp_us - from.timestamp_us) * 1e-6;
  for (int j = 0; j < kArmJointCount; ++j)
    if (std::abs(to.targets->arm->at(j) - from.targets->arm->at(j)) >
        radians_from_degrees(arm_joint_infos()[j].max_speed_deg_s) * seconds)
      return true;
  return false;
}

void expect_within_speed(const RobotCommand& from, const RobotCommand& to) {
  const double seconds = static_cast<double>(to.timestamp_us - from.timestamp_us) * 1e-6;
  for (int j = 0; j < kArmJointCount; ++j)
    EXPECT_LE(std::abs(to.targets->arm->at(j) - from.targets->arm->at(j)),
              radians_from_degrees(arm_joint_infos()[j].max_speed_deg_s) * seconds + 1e-12)
        << arm_joint_infos()[j].name << " at " << to.timestamp_us << " us";
}

/// Forth and back, so that successive frames are close.
std::vector<HandFrame> to_and_fro(const std::string& name, int times) {
  const auto frames = trajectories::source_trajectory(trajectory_folder(), name).frames;
  std::vector<HandFrame> path;
  for (int i = 0; i < times; ++i) {
    if (i % 2 == 0) path.insert(path.end(), frames.begin(), frames.end());
    if (i % 2 == 1) path.insert(path.end(), frames.rbegin(), frames.rend());
  }
  for (size_t i = 0; i < path.size(); ++i) path[i].timestamp_us = static_cast<int64_t>(i) * 66'667;
  return path;
}

/// Sends the truth through commander and guard.
ArmMotion arm_motion(const std::vector<HandFrame>& path) {
  RobotSetup setup;
  setup.arm = make_arm_solver();
  RobotCommander commander(setup);
  CommandGuard guard;
  ArmMotion motion;
  std::optional<RobotCommand> sent, wished;
  for (const auto& frame : path) {
    TrackResult result;
    result.timestamp_us = frame.timestamp_us;
    result.status = TrackStatus::tracked;
    result.posture = frame.posture;
    result.T_camera_hand = frame.T_camera_hand;
    const RobotCommand wish = commander.command(result);
    const std::optional<RobotCommand> safe = guard.guard(wish);
    if (sent) expect_within_speed(*sent, *safe);
    for (int j = 0; sent && j < kArmJointCount; ++j)
      motion.largest_wish =
          std::max(motion.largest_wish, std::abs(wish.targets->arm->at(j) - wished->targets->arm->at(j)));
    motion.too_fast += wished && is_too_fast(*wished, wish);
    sent = safe;
    wished = wish;
    ++motion.frames;
    motion.unreachable += safe->interventions[Intervention::arm_unreachable] > 0;
    motion.slowed += safe->interventions[Intervention::arm_speed] > 0;
  }
  return motion;
}

TEST(RobotArm, FollowsTheFiveTrajectoriesWithoutJumps) {
  if (!make_arm_solver()) GTEST_SKIP() << "built without Orocos KDL";
  for (const std::string& name : trajectories::ground_truth_names()) {
    const ArmMotion motion = arm_motion(to_and_fro(name, 5));
    fmt::print("{}: {} frames, {} out of reach, {} too fast, {} slowed down, largest wish {:.1f} degrees\n", name,
               motion.frames, motion.unreachable, motion.too_fast, motion.slowed,
               degrees_from_radians(motion.largest_wish));
    EXPECT_EQ(motion.unreachable, 0) << name;
    EXPECT_LT(motion.too_fast, motion.frames / 10) << name;
    EXPECT_LT(motion.largest_wish, radians_from_degrees(15)) << name << ": another branch is much farther away";
  }
}

}  // namespace
}  // namespace glovebench::eval
