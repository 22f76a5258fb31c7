#include "core/adapters/dds/dds_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "core/adapters/dds/dds_entity.h"
#include "core/adapters/dds/measured_robot.h"
#include "core/adapters/dds/server/motion_log.h"
#include "core/adapters/system_time.h"
#include "core/base/error.h"

namespace glovebench {
namespace {

constexpr int64_t kPeriodUs = 10'000;       // between states
constexpr int64_t kLookAroundUs = 100'000;  // between looks at other processes
constexpr int kMostStates = 10;             // of other servers, read at a look
constexpr int kMessagesAtOnce = 200;      // before the clock is read again, so that a flood delays no state by much
constexpr int64_t kListenUs = 1'000'000;  // to another server, before the first state
constexpr double kFastPace = 1.5;         // stamps against the clock; messages that waited 0.15 s explain 1.3
constexpr int64_t kManyLate = 10;         // stale messages; a few are the network's

int64_t steady_us() {
  using namespace std::chrono;
  return duration_cast<microseconds>(steady_clock::now().time_since_epoch()).count();
}

/// The server and its readers.
class Port {
 public:
  Port(const DdsParticipant& participant, const ServedRobot& robot, const RobotServer& at_start)
      : server(at_start) {
    if (robot.hand) fingers_.emplace(participant, topics::kOwn.hand);
    if (robot.hand) wrist_.emplace(participant, topics::kOwn.wrist);
    if (robot.arm) pose_.emplace(participant, topics::kOwn.arm);
  }

  void attach(DdsWaitset& waitset) {
    each([&](RobotTopic, auto& reader) { waitset.add(reader.entity()); });
  }
  std::set<uint64_t> present() {
    std::set<uint64_t> senders;
    each([&](RobotTopic, auto& reader) { senders.merge(reader.senders().present()); });
    return senders;
  }
  /// Receives all waiting messages and calls `report` for each that was read.
  template <typename Report>
  void receive(const Report& report) {
    each([&](RobotTopic topic, auto& reader) {
      for (int i = 0; i < kMessagesAtOnce; ++i) {
        const int64_t now_us = steady_us();
        const auto received = reader.take([&](uint64_t who) { return !server.stream().ignores(who, now_us); });
        if (!received) return;
        const auto& message = received->message;
        if (!message) continue;
        const Receipt receipt = server.receive(topic, *message, {received->sender, received->source_ns, now_us});
        report(topic, receipt, message->stamp, received->source_ns);
      }
    });
  }

  RobotServer server;

 private:
  template <typename Visit>
  void each(const Visit& visit) {
    if (fingers_) visit(RobotTopic::fingers, *fingers_);
    if (wrist_) visit(RobotTopic::wrist, *wrist_);
    if (pose_) visit(RobotTopic::pose, *pose_);
  }

  std::optional<DdsReader<ros::JointTrajectory>> fingers_, wrist_;
  std::optional<DdsReader<ros::PoseStamped>> pose_;
};

/// Finds other processes that publish a joint of hand or arm, and so serve the robot, too. Two servers, even of
/// different joints, would share no limit.
class OtherServers {
 public:
  explicit OtherServers(const DdsParticipant& participant)
      : states_(DdsReader<ros::JointState>::of_others(participant, topics::kOwn.joint_states)) {}

  /// A joint that another process has published since the last call.
  std::optional<std::string> heard() {
    std::optional<std::string> joint;
    for (int i = 0; i < kMostStates && !joint; ++i) {  // bounds the work at a flood
      const auto received = states_.take([](uint64_t) { return true; });
      if (!received) break;
      if (!received->message) continue;
      const auto& told = received->message->name;
      const auto ours = std::ranges::find_first_of(told, names_);
      if (ours != told.end()) joint = *ours;
    }
    return joint;
  }

 private:
  DdsReader<ros::JointState> states_;
  const std::vector<std::string> names_ = ServedRobot{true, MountedArm{}}.names();
};

template <typename Names, typename Counts>
std::string counted(int kinds, const Names& name, const Counts& count) {
  std::string text;
  for (int i = 0; i < kinds; ++i)
    if (count(i) > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count(i), name(i));
  return text.empty() ? "none" : text;
}

class Service {
 public:
  Service(Port& port, const DdsParticipant& participant, const DdsServerOptions& options, OtherServers& others,
          MotionLog& log)
      : port_(port),
        options_(options),
        name_(options.robot.name()),
        names_(options.robot.names()),
        others_(others),
        log_(log),
        states_(participant, topics::kOwn.joint_states),
        waitset_(participant) {
    port_.attach(waitset_);
  }

  DdsServerSummary run() {
    int64_t next_us = steady_us(), look_us = next_us;
    while (!options_.stopping()) {
      int64_t now_us = steady_us();
      if (now_us >= next_us) {
        tick(now_us);
        next_us = std::max(next_us + kPeriodUs, now_us);
      }
      if (now_us >= look_us) {
        port_.server.stream().keep_only(port_.present());
        look_for_others();
        look_at_log();
        look_at_stream();
        look_us = now_us + kLookAroundUs;
      }
      receive();
      now_us = steady_us();
      if (now_us < next_us) waitset_.wait((next_us - now_us) * 1000);
    }
    receive();  // messages from before the end count
    if (states_sent_ > 0) log_.finish(last_, system_us());
    return {summary(), log_.lost()};
  }

 private:
  void receive() {
    port_.receive([&](RobotTopic topic, Receipt receipt, const ros::Time& stamp, int64_t source_ns) {
      log_.received({system_us(), to_string(topic), receipt, nanoseconds(stamp), source_ns / 1000});
    });
  }
  void look_for_others() {
    const std::optional<std::string> joint = others_.heard();
    if (!joint) return;
    if (seen_others_++ == 0)
      options_.tell(fmt::format("{}: another process tells of {}, too: two servers of one robot?", name_, *joint));
  }
  void look_at_log() {
    if (log_.lost() > 0 && !std::exchange(told_of_log_, true))
      options_.tell(fmt::format("{}: found {}: lines are lost, and the joints hold", options_.log, log_.failure()));
  }
  /// Says once that the stream leaves the server behind, and how far.
  void look_at_stream() {
    const CommandStream& stream = port_.server.stream();
    if (stream.pace() > kFastPace && !std::exchange(told_of_pace_, true))
      options_.tell(
          fmt::format("{}: left behind: commands come {:.1f} times as fast as their frames were taken, and the "
                      "joints keep their speed limits",
                      name_, stream.pace()));
    if (const int64_t late = stream.count(Receipt::stale); late >= kManyLate && !std::exchange(told_of_late_, true))
      options_.tell(fmt::format("{}: left behind: {} commands came more than {:g} s late and move nothing", name_,
                                late, options_.limits.silence_s));
  }
  void tick(int64_t now_us) {
    if (now_us <= last_.clock_us) return;
    const int64_t elapsed_us = states_sent_ > 0 ? now_us - last_.clock_us : 0;
    longest_gap_us_ = std::max(longest_gap_us_, elapsed_us);
    const double step_s = std::min(static_cast<double>(elapsed_us) * 1e-6, options_.limits.longest_step_s);
    const bool may_move = log_.may_move(port_.server.positions(), step_s);
    const int64_t time_us = system_us();
    last_ = port_.server.tick({now_us, time_us}, may_move);
    states_.write({ros_time(time_us), names_, last_.position, last_.velocity}, time_us * 1000);
    const bool commanded = port_.server.stream().is_current(now_us);
    log_.ticked(last_, time_us, last_.state == CommandState::stopped && !commanded);
    waited_ += commanded && !may_move;
    ++states_sent_;
  }

  std::string summary() const {
    const CommandStream& stream = port_.server.stream();
    const Interventions& interventions = port_.server.interventions();
    std::string text = fmt::format(
        "{}: messages: {}; streams: {}; interventions: {}; states: {}, the longest gap {:.1f} ms", name_,
        counted(
            kCountOf<Receipt>, [](int i) { return to_string(static_cast<Receipt>(i)); },
            [&](int i) { return stream.count(static_cast<Receipt>(i)); }),
        stream.owners(),
        counted(
            kCountOf<Intervention>, [](int i) { return to_string(static_cast<Intervention>(i)); },
            [&](int i) { return interventions[static_cast<Intervention>(i)]; }),
        states_sent_, static_cast<double>(longest_gap_us_) * 1e-3);
    if (stream.gaps() > 0) text += fmt::format("; gaps: {}", stream.gaps());
    if (waited_ > 0) text += fmt::format("; held for the log: {} states", waited_);
    if (const int64_t count = dds_messages_too_large(); count > 0)
      text += fmt::format("; too large: {} messages", count);
    if (const int64_t count = dds_messages_of_too_many(); count > 0)
      text += fmt::format("; of too many writers: {} messages", count);
    if (seen_others_ > 0) text += fmt::format("; another server: heard at {} looks", seen_others_);
    if (log_.lost() > 0) text += fmt::format("; log: {} lines lost ({})", log_.lost(), log_.failure());
    return text;
  }

  Port& port_;
  const DdsServerOptions& options_;
  const std::string name_;
  const std::vector<std::string> names_;
  OtherServers& others_;
  MotionLog& log_;
  DdsWriter<ros::JointState> states_;
  DdsWaitset waitset_;
  RobotState last_;
  int64_t longest_gap_us_ = 0, states_sent_ = 0;
  int64_t waited_ = 0;  ///< states that waited for the disk with a command
  bool told_of_log_ = false, told_of_pace_ = false, told_of_late_ = false;
  int seen_others_ = 0;  ///< looks that found another server
};

/// Throws: Error if another server is heard.
void refuse_others(OtherServers& others, const DdsServerOptions& options) {
  if (const std::optional<std::string> joint = others.heard())
    throw Error(fmt::format("DDS domain {}", options.domain), topics::kOwn.joint_states,
                fmt::format("another process that tells of {}", *joint), "one server of a robot");
}

/// Listens for 1 s: a server publishes its joints all the time.
void refuse_beside(OtherServers& others, const DdsServerOptions& options) {
  const int64_t end_us = steady_us() + kListenUs;
  while (steady_us() < end_us && !options.stopping()) {
    refuse_others(others, options);
    std::this_thread::sleep_for(std::chrono::microseconds(kPeriodUs));
  }
}

/// Waits until the joints are measured. Empty if the server shall stop first.
/// Throws: Error if another server begins meanwhile.
std::optional<StartPlace> await_measured(const DdsParticipant& participant, const LoggedStart& logged,
                                         OtherServers& others, const DdsServerOptions& options) {
  const std::string topic = topics::kMeasuredJointStates;
  MeasuredRobot measured(participant, {topic}, options.robot.hand, options.robot.arm.has_value());
  options.tell(fmt::format("{}: {}: waits for a measured state on {}", logged.source, logged.doubt, topic));
  const std::vector<JointMotion> motions = options.robot.motions(options.limits);
  const double slowest = std::ranges::min_element(motions, {}, &JointMotion::speed)->speed;
  while (!options.stopping()) {
    refuse_others(others, options);
    if (std::optional<MeasuredState> state = measured.look()) {
      if (state->arm) state->hand.insert(state->hand.end(), state->arm->begin(), state->arm->end());
      return StartPlace{state->hand, topic, slowest * kPeriodUs * 1e-6};
    }
    std::this_thread::sleep_for(std::chrono::microseconds(kPeriodUs));
  }
  return std::nullopt;
}

}  // namespace

DdsServerSummary serve(const DdsServerOptions& options) {
  const ServedRobot& robot = options.robot;
  MotionLog log(options.log, robot.names(),
                robot.motions(options.limits));  // first: locks the log
  if (!options.log.empty() && !std::filesystem::is_regular_file(options.log))
    options.tell(fmt::format("{}: no regular file, so nothing on it is durable and no joint moves", options.log));
  const LoggedStart logged = log.start(robot.at_rest(), system_us(), options.max_log_age_s, kPeriodUs * 1e-6);
  std::optional<StartPlace> start = StartPlace{logged.joints, logged.source};
  if (logged.doubt.empty()) RobotServer(options.limits, robot, *start);  // throws if the start is no valid place
  const DdsParticipant participant(options.domain, options.access);
  OtherServers others(participant);
  refuse_beside(others, options);
  if (!logged.doubt.empty()) start = await_measured(participant, logged, others, options);
  if (!start) return {fmt::format("{}: ended before the joints were measured", robot.name()), 0};
  Port port(participant, robot, RobotServer(options.limits, robot, *start));
  if (logged.doubt.empty())
    options.tell(logged.age.empty()
                     ? fmt::format("{}: no state in a log: starts at rest", robot.name())
                     : fmt::format("{}: starts at its last state, of {}", logged.source, logged.age));
  log.started(system_us(), logged.doubt.empty() ? logged.from : "measured");
  return Service(port, participant, options, others, log).run();
}

}  // namespace glovebench
