#include "core/adapters/dds/measured_robot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "core/adapters/system_time.h"
#include "core/base/error.h"
#include "core/base/math.h"
#include "core/robot/guarded_motion.h"
#include "core/robot/shadow_kinematics.h"

namespace glovebench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPause = std::chrono::milliseconds(2);  // between two looks: shorter than a driver's period
constexpr int kDepth = 100;                            // waiting messages, also of other joints
constexpr int64_t kTellerUs = 1'000'000;               // after this silence a process publishes no more
constexpr size_t kMostTellers = 16;                    // two are too many already

std::string seconds(int64_t us) { return fmt::format("{:.2f} s", static_cast<double>(us) * 1e-6); }

/// Empty if a time is at most kMeasuredAgeUs from now.
std::string age_fault(const char* what, int64_t then_us, int64_t now_us) {
  if (now_us - then_us > kMeasuredAgeUs)
    return fmt::format("a state that is {} old by {}", seconds(now_us - then_us), what);
  if (then_us - now_us > kMeasuredAgeUs)
    return fmt::format("a state that is {} in the future by {}", seconds(then_us - now_us), what);
  return "";
}

/// A joint as it was measured, moved onto a limit that it exceeds by noise.
double within(double angle, double min, double max, std::string_view joint) {
  if (!(angle >= min - kMeasuredNoise && angle <= max + kMeasuredNoise))
    throw Error("measured state", std::string(joint), fmt::format("{:.2f} degrees", degrees_from_radians(angle)),
                fmt::format("{:.2f} to {:.2f}", degrees_from_radians(min), degrees_from_radians(max)));
  return std::clamp(angle, min, max);
}

/// The answer of the first source that has one. All are asked, so that each knows why it has none.
std::optional<std::vector<double>> latest(std::vector<MeasuredJoints>& sources) {
  const int64_t steady_us =
      std::chrono::duration_cast<std::chrono::microseconds>(Clock::now().time_since_epoch()).count();
  std::optional<std::vector<double>> first;
  for (MeasuredJoints& source : sources) {
    std::optional<std::vector<double>> its = source.latest(system_us(), steady_us);
    if (!first) first = std::move(its);
  }
  return first;
}

}  // namespace

MeasuredJoints::MeasuredJoints(const DdsParticipant& participant, const std::string& topic,
                               std::vector<std::string> names)
    : topic_(topic),
      names_(std::move(names)),
      reader_(DdsReader<ros::JointState>::of_others(participant, topic, kDepth)) {}

MeasuredJoints::State MeasuredJoints::read(const ros::JointState& message) const {
  State state;
  if (message.stamp.sec != 0 || message.stamp.nanosec != 0) state.stamp_us = nanoseconds(message.stamp) / 1000;
  if (message.position.size() != message.name.size()) {
    state.fault = fmt::format("{} positions of {} joints", message.position.size(), message.name.size());
    return state;
  }
  std::vector<std::string> missing;
  for (const std::string& name : names_) {
    const auto found = std::ranges::find(message.name, name);
    if (found == message.name.end()) {
      missing.push_back(name);
      continue;
    }
    const double position = message.position[static_cast<size_t>(found - message.name.begin())];
    if (std::find(found + 1, message.name.end(), name) != message.name.end())
      state.fault = fmt::format("{} twice", name);
    else if (!std::isfinite(position))
      state.fault = fmt::format("{} at {}", name, position);
    state.positions.push_back(position);
  }
  if (!missing.empty()) state.fault = fmt::format("a state without {}", fmt::join(missing, ", "));
  return state;
}

void MeasuredJoints::take_all(int64_t steady_us) {
  std::erase_if(tellers_, [&](const auto& teller) { return steady_us - teller.second > kTellerUs; });
  for (int i = 0; i < kDepth; ++i) {
    const auto received = reader_.take([](uint64_t) { return true; });
    if (!received) return;
    if (!received->message) continue;
    const ros::JointState& message = *received->message;
    if (std::ranges::find_first_of(message.name, names_) == message.name.end()) continue;
    if (tellers_.contains(received->sender) || tellers_.size() < kMostTellers)
      tellers_[received->sender] = steady_us;
    state_ = read(message);
    state_->source_us = received->source_ns / 1000;
    state_->taken_us = steady_us;
  }
}

std::string MeasuredJoints::find_doubt(int64_t system_us, int64_t steady_us) const {
  if (!state_) return "nothing of them";
  if (tellers_.size() > 1) return fmt::format("{} processes that tell of them", tellers_.size());
  if (!state_->fault.empty()) return state_->fault;
  if (steady_us - state_->taken_us > kMeasuredAgeUs)
    return fmt::format("nothing new for {}", seconds(steady_us - state_->taken_us));
  std::string fault = age_fault("its source time", state_->source_us, system_us);
  if (fault.empty() && state_->stamp_us) fault = age_fault("its stamp", *state_->stamp_us, system_us);
  return fault;
}

std::optional<std::vector<double>> MeasuredJoints::latest(int64_t system_us, int64_t steady_us) {
  take_all(steady_us);
  doubt_ = find_doubt(system_us, steady_us);
  if (!doubt_.empty()) return std::nullopt;
  return state_->positions;
}

MeasuredRobot::MeasuredRobot(const DdsParticipant& participant, const std::vector<std::string>& topics, bool hand,
                             bool arm) {
  dds_get_domainid(participant.entity(), &domain_);
  for (const std::string& topic : topics) {
    if (hand) hand_.emplace_back(participant, topic, hand_joint_names());
    if (arm) arm_.emplace_back(participant, topic, arm_joint_names());
  }
}

std::optional<MeasuredState> MeasuredRobot::look() {
  const std::optional<std::vector<double>> hand = latest(hand_), arm = latest(arm_);
  if ((!hand_.empty() && !hand) || (!arm_.empty() && !arm)) return std::nullopt;
  MeasuredState state{hand.value_or(std::vector<double>()), std::nullopt};
  if (arm) std::copy_n(arm->begin(), kArmJointCount, state.arm.emplace().begin());
  return state;
}

void MeasuredRobot::refuse() const {
  const bool of_hand =
      !hand_.empty() && std::ranges::none_of(hand_, [](const auto& its) { return its.doubt().empty(); });
  const std::vector<std::string>& names = of_hand ? hand_joint_names() : arm_joint_names();
  std::string found;
  for (const MeasuredJoints& its : of_hand ? hand_ : arm_)  // ROS's names of topics have no "rt" before them
    found += fmt::format("{}{} on {}", found.empty() ? "" : ", ", its.doubt(), its.topic().substr(2));
  throw Error(
      fmt::format("DDS domain {}", domain_), of_hand ? "measured state of the hand" : "measured state of the arm",
      found,
      fmt::format("all {} joints ({} ... {}), at most 0.1 s old", names.size(), names.front(), names.back()));
}

MeasuredState MeasuredRobot::state(double timeout_s) {
  const auto end = Clock::now() + std::chrono::duration<double>(timeout_s);
  for (;;) {
    if (std::optional<MeasuredState> state = look()) return *state;
    if (Clock::now() >= end) refuse();
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
