#include "core/robot/dds/measured_robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "core/base/angles.h"
#include "core/base/error.h"
#include "core/base/system_time.h"
#include "core/robot/dds/measured_joints.h"
#include "core/robot/dds/topics.h"
#include "core/robot/guarded_motion.h"
#include "core/robot/server/command_messages.h"
#include "core/robot/shadow_kinematics.h"

namespace glovebench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPause = std::chrono::milliseconds(2);  // between two looks: shorter than a driver's period

/// A joint as it was measured, moved onto a limit that it exceeds by noise.
double within(double angle, double min, double max, std::string_view joint) {
  if (!(angle >= min - kMeasuredNoise && angle <= max + kMeasuredNoise))
    throw Error("measured state", std::string(joint), fmt::format("{:.2f} degrees", degrees_from_radians(angle)),
                fmt::format("{:.2f} to {:.2f}", degrees_from_radians(min), degrees_from_radians(max)));
  return std::clamp(angle, min, max);
}

}  // namespace

class MeasuredRobot::Readers {
 public:
  Readers(int domain, const DdsAccess& access, bool with_arm)
      : where_(fmt::format("DDS domain {}", domain)), participant_(domain, access) {
    for (const char* topic : {topics::kMeasuredJointStates, topics::kController.joint_states}) {
      hand_.push_back(std::make_unique<MeasuredJoints>(participant_, topic, hand_joint_names()));
      if (with_arm) arm_.push_back(std::make_unique<MeasuredJoints>(participant_, topic, arm_joint_names()));
    }
  }

  /// Nothing if a joint is not known.
  std::optional<MeasuredState> look() {
    std::optional<std::vector<double>> hand = latest(hand_), arm = latest(arm_);
    if (!hand || (!arm_.empty() && !arm)) return std::nullopt;
    MeasuredState state{std::move(*hand), std::nullopt};
    if (arm) std::copy_n(arm->begin(), kArmJointCount, state.arm.emplace().begin());
    return state;
  }
  [[noreturn]] void refuse() const {
    const bool of_hand = std::ranges::none_of(hand_, [](const auto& its) { return its->doubt().empty(); });
    std::string found;
    for (const auto& its : of_hand ? hand_ : arm_)
      found += fmt::format("{}{} on {}", found.empty() ? "" : ", ", its->doubt(), ros_name(its->topic()));
    throw Error(where_, of_hand ? "measured state of the hand" : "measured state of the arm", found,
                fmt::format("all {} joints ({} ... {}), at most 0.1 s old",
                            (of_hand ? hand_ : arm_).front()->names().size(),
                            (of_hand ? hand_ : arm_).front()->names().front(),
                            (of_hand ? hand_ : arm_).front()->names().back()));
  }

 private:
  using Sources = std::vector<std::unique_ptr<MeasuredJoints>>;
  static std::optional<std::vector<double>> latest(const Sources& sources) {
    const int64_t steady_us =
        std::chrono::duration_cast<std::chrono::microseconds>(Clock::now().time_since_epoch()).count();
    std::optional<std::vector<double>> first;
    for (const auto& source : sources) {
      std::optional<std::vector<double>> its = source->latest(system_us(), steady_us);
      if (!first) first = std::move(its);
    }
    return first;
  }
  /// Without the "rt" before it.
  static std::string ros_name(const std::string& topic) { return topic.substr(2); }

  std::string where_;
  DdsParticipant participant_;
  Sources hand_, arm_;  ///< the one to prefer first
};

MeasuredRobot::MeasuredRobot(int domain, const DdsAccess& access, bool with_arm)
    : readers_(std::make_unique<Readers>(domain, access, with_arm)) {}

MeasuredRobot::~MeasuredRobot() = default;

MeasuredState MeasuredRobot::state(double timeout_s) {
  const auto end = Clock::now() + std::chrono::duration<double>(timeout_s);
  for (;;) {
    if (std::optional<MeasuredState> state = readers_->look()) return *state;
    if (Clock::now() >= end) readers_->refuse();
    std::this_thread::sleep_for(kPause);
  }
}

RobotTargets targets_at(const MeasuredState& state, const Eigen::Isometry3d& T_flange_wrist,
                        const Eigen::Isometry3d& T_base_hand) {
  RobotTargets targets;
  std::array<double, kShadowJointCount>& joints = targets.hand.joints;
  for (size_t j = 0; j < joints.size(); ++j) {
    const ShadowJointInfo& info = shadow_joint_infos()[j];
    joints[j] = within(state.hand.at(j), radians_from_degrees(info.min_deg), radians_from_degrees(info.max_deg),
                       hand_joint_names()[j]);
  }
  for (const ShadowActuatorInfo& info : shadow_actuator_infos()) {
    if (!info.coupled_joint) continue;
    double& distal = joints[*info.coupled_joint];
    distal = within(distal, 0, joints[info.joint], hand_joint_names()[*info.coupled_joint]);
  }
  make_actuators(targets.hand);
  targets.T_base_hand = T_base_hand;
  if (!state.arm) return targets;
  ArmJoints& arm = targets.arm.emplace(*state.arm);
  for (int j = 0; j < kArmJointCount; ++j) {
    const ArmJointInfo& info = arm_joint_infos()[j];
    arm[j] = within(arm[j], radians_from_degrees(info.min_deg), radians_from_degrees(info.max_deg), info.name);
  }
  targets.T_base_hand = arm_flange_pose(arm) * T_flange_wrist * shadow_T_wrist_hand(joints);
  return targets;
}

}  // namespace glovebench
