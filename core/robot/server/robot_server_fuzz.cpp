#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/angles.h"
#include "core/base/fuzz_target.h"
#include "core/robot/server/hand_server.h"
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

constexpr int64_t kGapUs = 100'000, kStartUs = 300'000;
constexpr int64_t kEpochUs = 1'800'000'000'000'000;

/// A hand's server, and what it has to keep to.
class Judge {
 public:
  void receive(uint8_t action, FuzzInput& input) {
    begun_ = true;
    const bool wrist = action % 3 == 2;
    const int64_t delay_us = int64_t{input.next<uint16_t>()} * (action & 128 ? 1000 : 1);
    const Arrival arrival{static_cast<uint64_t>(action / 3 % 4), (kEpochUs + now_us_ - delay_us) * 1000, now_us_};
    const Receipt receipt =
        server_.receive(wrist ? HandTopic::wrist : HandTopic::fingers,
                        message_from(input, wrist ? wrist_trajectory_names() : hand_trajectory_names()), arrival);
    if (receipt == Receipt::accepted) accepted_us_ = now_us_;
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
    check_limits(state, std::min(static_cast<double>(elapsed_us) * 1e-6, limits_.longest_step_s));
    check_hand(state, std::min(static_cast<double>(elapsed_us) * 1e-6, limits_.longest_step_s));
    const bool moved = state.position != last_;
    check(!moved || may_move, "nothing moves that may not");
    check(!moved || now_us_ - accepted_us_ <= std::llround(limits_.silence_s * 1e6), "nothing old moves anything");
    check(!moved || !gap_us_ || now_us_ - *gap_us_ >= kStartUs, "a gap needs a new start");
    last_ = state.position;
  }

 private:
  void check_limits(const RobotState& state, double seconds) const {
    for (size_t j = 0; j < last_.size(); ++j) {
      const ShadowJointInfo& info = shadow_joint_infos()[j];
      const double position = state.position[j];
      check(position >= radians_from_degrees(info.min_deg) && position <= radians_from_degrees(info.max_deg),
            "a joint keeps its limits");
      check(std::abs(position - last_[j]) <= limits_.hand_joint_speed * seconds + 1e-12, "a joint keeps its speed");
    }
  }

  void check_hand(const RobotState& state, double seconds) const {
    std::array<double, kShadowJointCount> before, after;
    std::ranges::copy(last_, before.begin());
    std::ranges::copy(state.position, after.begin());
    const TestFingertips::Tips way = TestFingertips(after).in_forearm() - TestFingertips(before).in_forearm();
    check(way.colwise().norm().maxCoeff() <= limits_.fingertip_speed * seconds * (1 + 1e-9) + 1e-9,
          "a fingertip keeps its speed");
    for (const int j1 : {kFFJ1, kMFJ1, kRFJ1, kLFJ1})
      check(std::abs(after[j1] - std::max(0.0, after[j1] + after[j1 + 1] - radians_from_degrees(90))) < 1e-12,
            "J1 and J2 are as their motor moves them");
  }

  CommandLimits limits_;
  std::vector<double> last_ = std::vector<double>(kShadowJointCount, 0.0);
  HandServer server_{limits_, {last_}};
  int64_t now_us_ = 0, jumped_us_ = 0, accepted_us_ = -kEpochUs;
  std::optional<int64_t> gap_us_;
  bool begun_ = false, ticked_ = false;  ///< before that there is nothing for a gap to be in
};

}  // namespace

/// A hand's server with any messages at any times: it never moves faster or farther than its limits, never by a
/// command that is old, and J1 as its motor moves it.
void robot_server_fuzz(std::string_view bytes) {
  Judge judge;
  FuzzInput input(bytes);
  while (!input.empty()) {
    const uint8_t action = input.next<uint8_t>();
    if (action % 3 == 0) {
      judge.tick(action, input);
    } else {
      judge.receive(action, input);
    }
  }
}

}  // namespace glovebench
