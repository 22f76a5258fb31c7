#pragma once

// This check is independent of the guard.

#include <cmath>
#include <string>

#include "core/robot/command_guard.h"
#include "core/robot/test_fingertips.h"

namespace glovebench {

class StreamChecker {
 public:
  explicit StreamChecker(const CommandLimits& limits) : limits_(limits) {}

  /// J1 and J2 may differ from their coupling.
  void start(const RobotTargets& targets) { targets_ = targets; }

  /// Empty: no problem.
  std::string problem(const RobotCommand& command) {
    std::string found = stamps(command);
    if (found.empty()) found = states(command);
    if (found.empty() && command.targets) found = places(*command.targets);
    if (found.empty() && command.targets) found = coupling(command.targets->hand.joints);
    if (found.empty() && command.targets && targets_) found = motion(*targets_, *command.targets, command);
    last_ = command;
    if (command.targets) targets_ = command.targets;
    if (command.state == CommandState::following) followed_us_ = command.timestamp_us;
    return found;
  }

 private:
  static constexpr double kDegree = 3.14159265358979323846 / 180;
  static constexpr double kTiny = 1e-12;     // rounding of sums, rad and m
  static constexpr double kTip = 1e-9;       // m: rounding of two computations
  static constexpr double kRotation = 5e-6;  // rad: rotations are exact to 1e-6

  std::string stamps(const RobotCommand& command) const {
    if (!last_) return "";
    if (command.timestamp_us <= last_->timestamp_us) return "a time stamp that does not rise";
    const bool paused = seconds(followed_us_, command.timestamp_us) > limits_.stop_after_s - limits_.silence_s;
    if (command.frame_timestamp_us < last_->frame_timestamp_us && !paused) return "a frame stamp that goes back";
    return "";
  }
  std::string states(const RobotCommand& command) const {
    const bool follows = command.state == CommandState::following;
    if (command.hold == follows) return "hold and state that contradict each other";
    if (follows && (!command.targets || command.status != TrackStatus::tracked)) return "nothing to follow";
    if (last_ && last_->targets && !command.targets) return "targets that vanish";
    return "";
  }

  std::string places(const RobotTargets& targets) const {
    for (int j = 0; j < kShadowJointCount; ++j) {
      // FF, MF, RF, LF, TH, WR, each from J1.
      static constexpr std::array<double, kShadowJointCount> lowest = {
          0, 0, -15, -20, 0, 0, -15, -20, 0, 0, -15, -20, 0, 0, -15, -20, 0, -15, -40, -12, 0, -60, -40, -28};
      static constexpr std::array<double, kShadowJointCount> highest = {
          90, 90, 90, 20, 90, 90, 90, 20, 90, 90, 90, 20, 90, 90, 90, 20, 45, 90, 40, 12, 70, 60, 28, 10};
      const double q = targets.hand.joints[j];
      if (!(q >= lowest[j] * kDegree - kTiny && q <= highest[j] * kDegree + kTiny))
        return "a joint outside its limits";
    }
    const auto& q = targets.hand.joints;
    const auto& m = targets.hand.actuators;
    for (const int finger : {0, 4, 8, 12})
      if (!(q[finger] <= q[finger + 1])) return "J1 above J2";
    const std::array<double, kShadowActuatorCount> motors = {
        q[0] + q[1], q[2],  q[3],  q[4] + q[5], q[6],  q[7],  q[8] + q[9], q[10], q[11], q[12] + q[13],
        q[14],       q[15], q[16], q[17],       q[18], q[19], q[20],       q[21], q[22], q[23]};
    if (m != motors) return "a motor that does not fit its joints";
    return other_places(targets);
  }
  std::string other_places(const RobotTargets& targets) const {
    const Eigen::Matrix3d R = targets.T_base_hand.linear();
    if (!((R.transpose() * R - Eigen::Matrix3d::Identity()).norm() < kRotation && R.determinant() > 0))
      return "a rotation that is none";
    const Eigen::Vector3d p = targets.T_base_hand.translation();
    for (int i = 0; i < 3; ++i)
      if (!(p[i] >= limits_.workspace_min[i] && p[i] <= limits_.workspace_max[i]))
        return "a hand outside the workspace";
    const TestFingertips::Tips tips = base_tips(targets);
    for (int i = 0; i < 3; ++i)
      if (!(tips.row(i).minCoeff() >= limits_.workspace_min[i] - kTip &&
            tips.row(i).maxCoeff() <= limits_.workspace_max[i] + kTip))
        return "a fingertip outside the workspace";
    static constexpr std::array<double, kArmJointCount> ends = {177, 94, 174, 137, 255, 165, 255};
    for (int j = 0; targets.arm && j < kArmJointCount; ++j)
      if (!(std::abs((*targets.arm)[j]) <= ends[j] * kDegree + kTiny)) return "an arm joint outside its limits";
    return "";
  }

  double off_model(const std::array<double, kShadowJointCount>& q, int finger) const {
    const double motor = q[finger] + q[finger + 1];
    const double alone = limits_.coupling == ShadowCoupling::even ? motor / 2 : std::max(0.0, motor - 90 * kDegree);
    return std::abs(q[finger] - alone);
  }
  std::string coupling(const std::array<double, kShadowJointCount>& q) const {
    for (const int finger : {0, 4, 8, 12})
      if (!(off_model(q, finger) <= (targets_ ? off_model(targets_->hand.joints, finger) : 0) + kTiny))
        return "J1 and J2 apart";
    return "";
  }

  static TestFingertips::Tips base_tips(const RobotTargets& targets) {
    return (targets.T_base_hand.linear() * TestFingertips(targets.hand.joints).in_hand()).colwise() +
           Eigen::Vector3d(targets.T_base_hand.translation());
  }

  std::string motion(const RobotTargets& from, const RobotTargets& to, const RobotCommand& command) const {
    double time = limits_.longest_step_s;
    if (last_) time = std::min(time, seconds(last_->timestamp_us, command.timestamp_us));
    if (command.state != CommandState::following) time = 0;
    const auto farther = [&](double way, double speed) {
      return !(std::abs(way) <= speed * time * (1 + 1e-9) + kTiny);
    };
    for (int j = 0; j < kShadowJointCount; ++j)
      if (farther(to.hand.joints[j] - from.hand.joints[j], limits_.hand_joint_speed)) return "a joint too fast";
    if (farther((to.T_base_hand.translation() - from.T_base_hand.translation()).norm(), limits_.hand_speed))
      return "a hand too fast";
    if (angle(from.T_base_hand.linear(), to.T_base_hand.linear()) > limits_.hand_turn_speed * time + kRotation)
      return "a hand that turns too fast";
    for (int f = 0; f < 5; ++f) {
      const double way = (base_tips(to).col(f) - base_tips(from).col(f)).norm();
      if (!(way <= limits_.fingertip_speed * time * (1 + 1e-9) + kTip)) return "a fingertip too fast";
    }
    if (from.arm && !to.arm) return "an arm that vanishes";
    static constexpr std::array<double, kArmJointCount> speeds = {57, 57, 114, 114, 360, 360, 360};
    for (int j = 0; from.arm && j < kArmJointCount; ++j)
      if (farther((*to.arm)[j] - (*from.arm)[j], limits_.arm_speed_share * speeds[j] * kDegree))
        return "an arm joint too fast";
    return "";
  }

  static double seconds(int64_t from_us, int64_t to_us) {
    return static_cast<double>((static_cast<long double>(to_us) - static_cast<long double>(from_us)) * 1e-6L);
  }
  static double angle(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B) {
    const Eigen::Matrix3d R = A.transpose() * B;
    const Eigen::Vector3d twice_sine(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
    return std::atan2(twice_sine.norm(), R.trace() - 1);
  }

  CommandLimits limits_;
  std::optional<RobotCommand> last_;
  std::optional<RobotTargets> targets_;
  int64_t followed_us_ = INT64_MIN;
};

}  // namespace glovebench
