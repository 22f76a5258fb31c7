#include "eval/commands/robot_outputs.h"

#include <charconv>
#include <chrono>

#include "core/base/error.h"
#ifdef GLOVEBENCH_DDS
#include "core/robot/dds/dds_sink.h"
#include "core/robot/dds/measured_robot.h"
#endif

namespace glovebench::eval {

void BusFlags::add(Command command, const std::string& what) {
  command.option("--robot", middleware, what);
  command.option("--robot-interface", interface,
                 "network interface for --robot [loopback alone, or what CYCLONEDDS_URI says]");
  command.option("--security", security, "folder of keys for DDS Security (`glovebench robot-server keys`) [none]");
}

int BusFlags::domain() const {
  constexpr std::string_view kDds = "dds";
  const std::string_view rest = std::string_view(middleware).substr(std::min(kDds.size(), middleware.size()));
  int domain = 0;
  bool known = middleware.starts_with(kDds);
  if (known && !rest.empty()) {
    const auto [stop, error] = std::from_chars(rest.data() + 1, rest.data() + rest.size(), domain);
    known = rest[0] == ':' && error == std::errc() && stop == rest.data() + rest.size() && domain >= 0;
  }
  if (!known) throw Error("--robot", "middleware", middleware, "dds or dds:DOMAIN");
#ifndef GLOVEBENCH_DDS
  throw Error("--robot", middleware, "a glovebench that was built without Cyclone DDS",
              "one that was configured with it (Debian: cyclonedds-dev, cyclonedds-tools)");
#endif
  return domain;
}

#ifdef GLOVEBENCH_DDS
namespace {

constexpr double kFirstWait = 3;    // s, for a measured state: participants find each other in less than one
constexpr double kStartWait = 0.5;  // s, for one when the first command is there: it has been there before

DdsAccess access_of(const BusFlags& bus) {
  return {bus.interface, bus.security, "sender"};
}
DdsSinkOptions sink_options(const RobotStream& stream) {
  if (!stream.to_controller()) return {access_of(stream.bus), topics::kOwn, true, stream.longest_step_s};
  return {access_of(stream.bus), topics::kController, stream.arm, stream.longest_step_s, true};
}

}  // namespace

class RobotOutputs::Stream {
 public:
  explicit Stream(const RobotStream& stream)
      : sink(stream.bus.domain(), sink_options(stream)), T_flange_wrist_(stream.T_flange_wrist) {
    if (!stream.to_controller()) return;
    const std::vector<std::string> from = {topics::kMeasuredJointStates, topics::kController.joint_states};
    measured_.emplace(participant_.emplace(stream.bus.domain(), access_of(stream.bus)), from, true, stream.arm);
  }

  /// Empty unless it matters.
  std::optional<MeasuredState> wait_for_robot() {
    if (!measured_) return std::nullopt;
    return measured_->state(kFirstWait);
  }
  /// Tells the guard where the robot stands if it has to know. Returns the time of the command.
  int64_t start(CommandGuard& guard, const RobotCommand& command) {
    const int64_t now = now_us(command);
    if (!measured_ || command.hold || !command.targets || guard.state_at(now) == CommandState::following)
      return now;
    // Without an arm the pose is not sent, but the guard needs one: the hand's, so far inside that every fingertip
    // is.
    Eigen::Isometry3d T_base_hand = command.targets->T_base_hand;
    const CommandLimits& limits = guard.limits();
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(kShadowHandReach);
    T_base_hand.translation() = T_base_hand.translation()
                                    .cwiseMax(limits.workspace_min + reach)
                                    .cwiseMin(limits.workspace_max - reach)
                                    .eval();
    guard.start_from(targets_at(measured_->state(kStartWait), T_flange_wrist_, T_base_hand));
    const int64_t measured_us = now_us(command);
    guard.tick(measured_us - 1);  // the first command is the place where the robot stands
    return measured_us;
  }

  DdsSink sink;

 private:
  /// Microseconds: the first frame's time stamp plus what has passed since then on the wall.
  int64_t now_us(const RobotCommand& command) {
    using namespace std::chrono;
    const int64_t clock_us = duration_cast<microseconds>(steady_clock::now().time_since_epoch()).count();
    if (!first_us_) first_us_ = command.timestamp_us - clock_us;
    return *first_us_ + clock_us;
  }

  Eigen::Isometry3d T_flange_wrist_;
  std::optional<DdsParticipant> participant_;  ///< of what is measured
  std::optional<MeasuredRobot> measured_;
  std::optional<int64_t> first_us_;  ///< of the first frame, less the clock at that time
};
#else
class RobotOutputs::Stream {
 public:
  explicit Stream(const RobotStream& stream) { stream.bus.domain(); }
  struct {
    void frame_arrived(int64_t) {}
    void send(const RobotCommand&) {}
    void finish() {}
  } sink;
  int64_t start(CommandGuard&, const RobotCommand& command) { return command.timestamp_us; }
};
#endif

RobotOutputs::RobotOutputs(const RobotStream& stream) {
  if (!stream.bus.middleware.empty()) {
    stream_ = std::make_unique<Stream>(stream);
#ifdef GLOVEBENCH_DDS
    if (const auto robot = stream_->wait_for_robot()) arm_start_ = robot->arm;
#endif
  }
  if (!stream.file.empty()) file_ = std::make_unique<JsonLinesSink>(stream.file);
}

RobotOutputs::~RobotOutputs() = default;

void RobotOutputs::send(CommandGuard& guard, const RobotCommand& command, int64_t arrived_us) {
  const int64_t now_us = stream_ ? stream_->start(guard, command) : command.timestamp_us;
  const std::optional<RobotCommand> safe = guard.guard(command, now_us);
  if (!safe) return;
  if (stream_) {  // first: a slow disk does not hold the robot up
    stream_->sink.frame_arrived(arrived_us);
    stream_->sink.send(*safe);
  }
  if (file_) file_->send(*safe);
}

void RobotOutputs::finish(bool whole) {
  if (stream_) stream_->sink.finish();
  if (file_ && whole) file_->finish();
}

}  // namespace glovebench::eval
