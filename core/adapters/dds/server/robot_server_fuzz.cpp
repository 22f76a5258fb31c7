#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/adapters/dds/server/robot_server.h"
#include "core/base/fuzz_target.h"
#include "core/base/math.h"
#include "core/robot/test_arm_solver.h"
#include "core/robot/test_fingertips.h"

namespace glovebench {
namespace {

/// A message that is right but for what the input changes.
ros::JointTrajectory message_from(FuzzInput& input, const std::vector<std::string>& names) {
  ros::JointTrajectory message;
  message.stamp = {input.next<int32_t>(), input.next<uint32_t>()};
  message.joint_names = names;
  message.points.push_back({std::vector<double>(names.size(), input.next<double>()), {0, input.next<uint32_t>()}});
  const uint8_t change = input.next<uint8_t>();
  const size_t at = input.next<uint8_t>() % names.size();
  if (change & 1) message.joint_names[at] = names[input.next<uint8_t>() % names.size()];
  if (change & 2) message.points[0].positions[at] = input.next<double>();
  if (change & 4) message.points[0].positions.resize(input.next<uint8_t>());
  if (change & 8) message.joint_names.resize(input.next<uint8_t>());
  if (change & 16) message.points.resize(input.next<uint8_t>() % 4, message.points[0]);
  return message;
}

/// A pose near that one.
ros::PoseStamped pose_from(FuzzInput& input, const Eigen::Isometry3d& T_base_wrist) {
  ros::PoseStamped message;
  message.stamp = {input.next<int32_t>(), input.next<uint32_t>()};
  message.frame_id = kBaseFrame;
  const Eigen::Vector3d p = T_base_wrist.translation();
  message.x = p.x() + 0.01 * input.next<int8_t>();
  message.y = p.y() + 0.01 * input.next<int8_t>();
  message.z = p.z() + 0.01 * input.next<int8_t>();
  const Eigen::Quaterniond q(T_base_wrist.linear() *
                             Eigen::AngleAxisd(0.02 * input.next<int8_t>(), Eigen::Vector3d::UnitX()));
  message.qx = q.x(), message.qy = q.y(), message.qz = q.z(), message.qw = q.w();
  const uint8_t change = input.next<uint8_t>();
  if (change & 1) message.frame_id = "world";
  if (change & 2) message.x = input.next<double>();
  if (change & 4) message.qw = input.next<double>();
  return message;
}

constexpr int64_t kGapUs = 100'000, kStartUs = 300'000;
constexpr int64_t kEpochUs = 1'800'000'000'000'000;

/// A server of the hand, or of hand and arm, and what it has to keep to.
class Judge {
 public:
  explicit Judge(bool with_arm)
      : robot_{true, with_arm ? std::optional(MountedArm{&solver_, default_T_flange_wrist()}) : std::nullopt} {}

  void receive(uint8_t action, FuzzInput& input) {
    begun_ = true;
    const RobotTopic topic = (action & 112) == 48 ? RobotTopic::pose
                             : action % 3 == 2    ? RobotTopic::wrist
                                                  : RobotTopic::fingers;
    const int64_t delay_us = int64_t{input.next<uint16_t>()} * (action & 128 ? 1000 : 1);
    const Arrival arrival{static_cast<uint64_t>(action / 3 % 4), (kEpochUs + now_us_ - delay_us) * 1000, now_us_};
    Receipt receipt = Receipt::foreign;
    if (topic == RobotTopic::pose) {
      const ros::PoseStamped message = pose_from(input, T_base_wrist(robot_.at_rest()));
      if (robot_.arm) receipt = server_.receive(topic, message, arrival);
    } else {
      receipt = server_.receive(
          topic,
          message_from(input, topic == RobotTopic::wrist ? wrist_trajectory_names() : hand_trajectory_names()),
          arrival);
    }
    if (receipt != Receipt::accepted) return;
    accepted_us_[static_cast<size_t>(topic)] = now_us_;
  }

  void tick(uint8_t action, FuzzInput& input) {
    const int64_t elapsed_us = 1 + input.next<uint16_t>() * (action & 128 ? 100 : 1);
    const int64_t jump_us = action & 64 ? input.next<int32_t>() : 0;
    now_us_ += elapsed_us;
    jumped_us_ += jump_us;
    if ((begun_ && elapsed_us > kGapUs) || (ticked_ && std::abs(jump_us) > kGapUs)) gap_us_ = now_us_;
    begun_ = ticked_ = true;
    const bool may_move = (action & 32) == 0;
    const RobotState state = server_.tick({now_us_, kEpochUs + now_us_ + jumped_us_}, may_move);
    const double seconds = std::min(static_cast<double>(elapsed_us) * 1e-6, limits_.longest_step_s);
    check_limits(state, seconds);
    check_fingertips(state, seconds);
    const bool moved = state.position != last_;
    check(!moved || may_move, "nothing moves that may not");
    for (size_t j = 0; j < last_.size(); ++j)
      check(state.position[j] == last_[j] || is_followed(accepted_us_[static_cast<size_t>(topic_of(j))]),
            "nothing old moves a joint");
    check(!moved || !gap_us_ || now_us_ - *gap_us_ >= kStartUs, "a gap needs a new start");
    last_ = state.position;
  }

 private:
  /// Who commands a joint.
  static RobotTopic topic_of(size_t joint) {
    if (joint >= kShadowJointCount) return RobotTopic::pose;
    return joint == kWRJ1 || joint == kWRJ2 ? RobotTopic::wrist : RobotTopic::fingers;
  }

  bool is_followed(int64_t accepted_us) const {
    return now_us_ - accepted_us <= std::llround(limits_.silence_s * 1e6);
  }

  void check_limits(const RobotState& state, double seconds) const {
    const std::vector<JointMotion> motions = robot_.motions(limits_);
    for (size_t j = 0; j < last_.size(); ++j) {
      const double position = state.position[j];
      check(position >= motions[j].min && position <= motions[j].max, "a joint keeps its limits");
      check(std::abs(position - last_[j]) <= motions[j].speed * seconds * (1 + 1e-9) + 1e-12,
            "a joint keeps its speed");
    }
  }

  static std::array<double, kShadowJointCount> hand_of(const std::vector<double>& positions) {
    std::array<double, kShadowJointCount> joints;
    std::copy_n(positions.begin(), joints.size(), joints.begin());
    return joints;
  }
  Eigen::Isometry3d T_base_wrist(const std::vector<double>& positions) const {
    if (!robot_.arm) return Eigen::Isometry3d(Eigen::Translation3d(0, 0, 1));
    ArmJoints joints;
    std::copy_n(positions.begin() + kShadowJointCount, joints.size(), joints.begin());
    return robot_.arm->T_base_wrist(joints);
  }
  TestFingertips::Tips fingertips(const std::vector<double>& positions) const {
    const Eigen::Isometry3d T = T_base_wrist(positions);
    return (T.linear() * TestFingertips(hand_of(positions)).in_forearm()).colwise() + T.translation();
  }
  void check_fingertips(const RobotState& state, double seconds) const {
    const TestFingertips::Tips before = fingertips(last_), after = fingertips(state.position);
    check((after - before).colwise().norm().maxCoeff() <= limits_.fingertip_speed * seconds * (1 + 1e-9) + 1e-9,
          "a fingertip keeps its speed in the arm's base frame");
    check((after.colwise() - limits_.workspace_min).minCoeff() >= -1e-4 &&
              (after.colwise() - limits_.workspace_max).maxCoeff() <= 1e-4,
          "a fingertip stays in the workspace");
    const std::array<double, kShadowJointCount> hand = hand_of(state.position);
    for (const int j1 : {kFFJ1, kMFJ1, kRFJ1, kLFJ1})
      check(std::abs(hand[j1] - std::max(0.0, hand[j1] + hand[j1 + 1] - radians_from_degrees(90))) < 1e-12,
            "J1 and J2 are as their motor moves them");
  }

  CommandLimits limits_;
  JacobianSolver solver_;
  ServedRobot robot_;
  std::vector<double> last_ = robot_.at_rest();
  RobotServer server_{limits_, robot_, {last_}};
  int64_t now_us_ = 0, jumped_us_ = 0;
  /// When the last message of each topic was accepted.
  std::array<int64_t, kRobotTopicCount> accepted_us_ = {-kEpochUs, -kEpochUs, -kEpochUs};
  std::optional<int64_t> gap_us_;
  bool begun_ = false, ticked_ = false;  ///< before that there is nothing for a gap to be in
};

}  // namespace

/// A server of hand and arm with any messages at any times: nothing moves faster or farther than the limits, or by
/// a command that is old, and J1 moves as its motor does.
void robot_server_fuzz(std::string_view bytes) {
  without_error([&] {
    for (const bool with_arm : {false, true}) {
      Judge judge(with_arm);
      FuzzInput input(bytes);
      while (!input.empty()) {
        const uint8_t action = input.next<uint8_t>();
        if (action % 3 == 0)
          judge.tick(action, input);
        else
          judge.receive(action, input);
      }
    }
  });
}

}  // namespace glovebench
