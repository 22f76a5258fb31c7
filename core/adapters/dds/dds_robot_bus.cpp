#include <chrono>
#include <string>
#include <vector>

#include "core/adapters/dds/dds_sink.h"
#include "core/adapters/dds/measured_robot.h"
#include "core/adapters/dds/robot_bus.h"
#include "core/robot/shadow_hand.h"

namespace glovebench {
namespace {

constexpr double kFirstWait = 3;    // s, for a measured state: participants find each other in less than one
constexpr double kStartWait = 0.5;  // s, for one when the first command is there: it has been there before

DdsSinkOptions sink_options(const RobotBusOptions& options) {
  if (!options.to_controller) return {options.access, topics::kOwn, true, options.longest_step_s};
  return {options.access, topics::kController, options.arm, options.longest_step_s, true};
}

class DdsRobotBus : public RobotBus {
 public:
  explicit DdsRobotBus(const RobotBusOptions& options)
      : T_flange_wrist_(options.T_flange_wrist), sink_(options.domain, sink_options(options)) {
    if (!options.to_controller) return;
    const std::vector<std::string> from = {topics::kMeasuredJointStates, topics::kController.joint_states};
    measured_.emplace(participant_.emplace(options.domain, options.access), from, true, options.arm);
    arm_start_ = measured_->state(kFirstWait).arm;
  }

  std::optional<ArmJoints> arm_start() const override { return arm_start_; }

  int64_t start(CommandGuard& guard, const RobotCommand& command) override {
    const int64_t now = now_us(command);
    if (!measured_ || command.hold || !command.targets || guard.state_at(now) == CommandState::following)
      return now;
    // Without an arm no pose is sent, but the guard needs one: a hand so far inside that all fingertips are inside.
    Eigen::Isometry3d T_base_hand = command.targets->T_base_hand;
    const CommandLimits& limits = guard.limits();
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(kShadowHandReach);
    T_base_hand.translation() = T_base_hand.translation()
                                    .cwiseMax(limits.workspace_min + reach)
                                    .cwiseMin(limits.workspace_max - reach)
                                    .eval();
    guard.start_from(targets_at(measured_->state(kStartWait), T_flange_wrist_, T_base_hand));
    const int64_t measured_us = now_us(command);
    guard.tick(measured_us - 1);  // the first command is the robot's place
    return measured_us;
  }

  void send(const RobotCommand& safe, int64_t arrived_us) override {
    sink_.frame_arrived(arrived_us);
    sink_.send(safe);
  }
  void finish() override { sink_.finish(); }

 private:
  int64_t now_us(const RobotCommand& command) {
    using namespace std::chrono;
    const int64_t clock_us = duration_cast<microseconds>(steady_clock::now().time_since_epoch()).count();
    if (!first_us_) first_us_ = command.timestamp_us - clock_us;
    return *first_us_ + clock_us;
  }

  Eigen::Isometry3d T_flange_wrist_;
  DdsSink sink_;
  std::optional<DdsParticipant> participant_;  ///< for measurements
  std::optional<MeasuredRobot> measured_;
  std::optional<ArmJoints> arm_start_;
  std::optional<int64_t> first_us_;  ///< time stamp of the first frame minus the clock then
};

}  // namespace

const bool kHasDds = true;

std::unique_ptr<RobotBus> join_robot_bus(const RobotBusOptions& options) {
  return std::make_unique<DdsRobotBus>(options);
}

}  // namespace glovebench
