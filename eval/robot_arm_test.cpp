#include <gmock/gmock.h>

#include "core/base/angles.h"
#include "core/robot/command_guard.h"
#include "eval/share.h"
#include "trajectories/catalog.h"
#ifdef GLOVEBENCH_ARM
#include "core/robot/arm/kdl_arm_solver.h"

namespace glovebench::eval {
namespace {

struct ArmMotion {
  int frames = 0, unreachable = 0, slowed = 0;
  double largest_wish = 0;  ///< of a joint from frame to frame, rad, before the guard
};

/// The truth of a trajectory as if it was tracked, through commander and guard.
ArmMotion arm_motion(const std::string& name) {
  RobotSetup setup;
  setup.arm = make_kdl_arm_solver();
  RobotCommander commander(setup);
  CommandGuard guard;
  ArmMotion motion;
  std::optional<RobotCommand> sent, wished;
  for (const auto& frame : trajectories::source_trajectory(trajectory_folder(), name).frames) {
    TrackResult result;
    result.timestamp_us = frame.timestamp_us;
    result.status = TrackStatus::tracked;
    result.posture = frame.posture;
    result.T_camera_hand = frame.T_camera_hand;
    const RobotCommand wish = commander.command(result);
    const std::optional<RobotCommand> safe = guard.guard(wish);
    for (int j = 0; sent && j < kArmJointCount; ++j) {
      motion.largest_wish =
          std::max(motion.largest_wish, std::abs(wish.targets->arm->at(j) - wished->targets->arm->at(j)));
      const double seconds = static_cast<double>(safe->timestamp_us - sent->timestamp_us) * 1e-6;
      EXPECT_LE(std::abs(safe->targets->arm->at(j) - sent->targets->arm->at(j)),
                radians_from_degrees(arm_joint_infos()[j].max_speed_deg_s) * seconds + 1e-12)
          << name << ", " << arm_joint_infos()[j].name << " at " << safe->timestamp_us << " us";
    }
    sent = safe;
    wished = wish;
    ++motion.frames;
    motion.unreachable += safe->interventions[Intervention::arm_unreachable] > 0;
    motion.slowed += safe->interventions[Intervention::arm_speed] > 0;
  }
  return motion;
}

TEST(RobotArm, FollowsTheFiveTrajectoriesWithoutJumps) {
  for (const std::string& name : trajectories::ground_truth_names()) {
    const ArmMotion motion = arm_motion(name);
    fmt::print("{}: {} frames, {} out of reach, {} slowed down, largest wish {:.1f} degrees\n", name, motion.frames,
               motion.unreachable, motion.slowed, degrees_from_radians(motion.largest_wish));
    // Where the wrist is straight a frame may be refused; a branch that was taken and lost would cost many.
    EXPECT_LE(motion.unreachable, 1) << name;
    EXPECT_LT(motion.slowed, motion.frames / 3) << name;
    EXPECT_LT(motion.largest_wish, radians_from_degrees(60)) << name << ": another branch is a half turn away";
  }
}

}  // namespace
}  // namespace glovebench::eval
#endif
