#include "bench/movements.h"

#include <fmt/format.h>

#include "core/base/angles.h"
#include "core/base/random.h"
#include "trajectories/catalog.h"
#include "trajectories/generation/motion_script.h"

namespace glovebench::bench {
namespace {

using trajectories::MotionScript;

constexpr size_t kFrameStep = 19;  // six to eight frames of each trajectory: open hand, grasp and between
constexpr int kHeldOut = 10;
/// A key every so many frames, and so many frames in all: 8.8 s.
constexpr int kKeyStep = 12, kFrameCount = 11 * kKeyStep + 1;

Movement movement_of(const trajectories::Trajectory& trajectory) {
  Movement movement{trajectory.name, {}};
  for (size_t f = 0; f < trajectory.frames.size(); f += kFrameStep) movement.frames.push_back(trajectory.frames[f]);
  return movement;
}

double random_angle(RandomStream& random, double largest_deg) {
  return radians_from_degrees(random.uniform(-largest_deg, largest_deg));
}

trajectories::HandPose random_pose(RandomStream& random) {
  const double x = random.uniform(-0.12, 0.12), y = random.uniform(0, 0.06), z = random.uniform(0.65, 0.82);
  const double yaw = random_angle(random, 45), pitch = random_angle(random, 25), roll = random_angle(random, 25);
  return {{x, y, z}, trajectories::hand_rotation(yaw, pitch, roll)};
}

MotionScript random_script(const PostureSet& gestures, int number) {
  RandomStream random(1, "held-out movement", number, "script");
  MotionScript script;
  script.name = fmt::format("HeldOut{}", number + 1);
  script.seed = 100 + static_cast<uint64_t>(number);
  script.frame_count = kFrameCount;
  for (int frame = 0; frame < kFrameCount; frame += kKeyStep) {
    const auto gesture = [&] { return gestures.postures[random.index(gestures.postures.size())]; };
    const Posture a = gesture(), b = gesture();
    const double share = random.uniform(0, 1);
    script.postures.push_back({frame, share * a + (1 - share) * b});
    script.wrist.push_back({frame, {random_angle(random, 14), random_angle(random, 8)}});
    script.poses.push_back({frame, random_pose(random)});
  }
  return script;
}

}  // namespace

std::vector<Movement> tuned_movements(const std::string& trajectory_folder) {
  std::vector<Movement> movements;
  for (const std::string& name : trajectories::ground_truth_names())
    movements.push_back(movement_of(trajectories::source_trajectory(trajectory_folder, name)));
  return movements;
}

std::vector<Movement> held_out_movements(const std::string& trajectory_folder) {
  const PostureSet gestures = trajectories::load_gestures(trajectory_folder);
  std::vector<Movement> movements;
  for (int number = 0; number < kHeldOut; ++number)
    movements.push_back(movement_of(perform(random_script(gestures, number))));
  return movements;
}

}  // namespace glovebench::bench
