#include "core/robot/dds/dds_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/system_time.h"
#include "core/robot/dds/dds_entity.h"
#include "core/robot/dds/topics.h"
#include "core/robot/server/arm_server.h"
#include "core/robot/server/hand_server.h"
#include "core/robot/server/server_log.h"

namespace glovebench {
namespace {

constexpr int64_t kPeriodUs = 10'000;        // between two states
constexpr int64_t kLookAroundUs = 100'000;   // between two looks at who is there
constexpr int64_t kHeartbeatUs = 1'000'000;  // a state in the log even if nothing moves
constexpr int kLogLinesPerSecond = 500;      // of messages, accepted and refused each: a flood fills no disk
constexpr int kMostStates = 10;              // of other servers, at a look
constexpr int kMessagesAtOnce = 200;         // then the clock is asked again: a flood delays no state by much
constexpr uint64_t kTailBytes = 1 << 20;     // seconds of the fullest log
constexpr int64_t kListenUs = 1'000'000;     // for another server, before the first state

int64_t steady_us() {
  using namespace std::chrono;
  return duration_cast<microseconds>(steady_clock::now().time_since_epoch()).count();
}

/// The hand and its readers.
class HandPort {
 public:
  static constexpr const char* kName = "hand";
  HandPort(const DdsParticipant& participant, HandServer at_start)
      : server(std::move(at_start)),
        fingers_(participant, topics::kOwn.hand),
        wrist_(participant, topics::kOwn.wrist) {}

  static const std::vector<std::string>& names() { return hand_joint_names(); }
  void attach(DdsWaitset& waitset) const {
    waitset.add(fingers_.entity());
    waitset.add(wrist_.entity());
  }
  template <typename Report>
  void receive(const Report& report) {
    receive(fingers_, HandTopic::fingers, "fingers", report);
    receive(wrist_, HandTopic::wrist, "wrist", report);
  }
  std::set<uint64_t> present() {
    std::set<uint64_t> senders = fingers_.senders().present();
    senders.merge(wrist_.senders().present());
    return senders;
  }

  HandServer server;

 private:
  template <typename Report>
  void receive(DdsReader<ros::JointTrajectory>& reader, HandTopic topic, const char* name, const Report& report) {
    for (int i = 0; i < kMessagesAtOnce; ++i) {
      const int64_t now_us = steady_us();
      const auto received = reader.take([&](uint64_t sender) { return !server.ignores(sender, now_us); });
      if (!received) return;
      const auto& message = received->message;
      if (!message) continue;
      report(name, server.receive(received->sender, topic, *message, now_us), message->stamp, received->source_ns);
    }
  }

  DdsReader<ros::JointTrajectory> fingers_, wrist_;
};

/// The arm and its reader.
class ArmPort {
 public:
  static constexpr const char* kName = "arm";
  ArmPort(const DdsParticipant& participant, ArmServer at_start)
      : server(std::move(at_start)), pose_(participant, topics::kOwn.arm) {}

  static const std::vector<std::string>& names() { return arm_joint_names(); }
  void attach(DdsWaitset& waitset) const { waitset.add(pose_.entity()); }
  template <typename Report>
  void receive(const Report& report) {
    for (int i = 0; i < kMessagesAtOnce; ++i) {
      const int64_t now_us = steady_us();
      const auto received = pose_.take([&](uint64_t sender) { return !server.ignores(sender, now_us); });
      if (!received) return;
      const auto& message = received->message;
      if (!message) continue;
      report("pose", server.receive(received->sender, *message, now_us), message->stamp, received->source_ns);
    }
  }
  std::set<uint64_t> present() { return pose_.senders().present(); }

  ArmServer server;

 private:
  DdsReader<ros::PoseStamped> pose_;
};

/// Where the joints start, and who says so.
struct StartPlace {
  std::vector<double> joints;
  std::string source;
};

/// Whether another process says where these joints are: it serves them, too.
class OtherServers {
 public:
  OtherServers(const DdsParticipant& participant, const std::vector<std::string>& names)
      : states_(DdsReader<ros::JointState>::of_others(participant, topics::kOwn.joint_states)), names_(names) {}

  /// The name of a joint that another has told of since the last call.
  std::optional<std::string> heard() {
    std::optional<std::string> joint;
    for (int i = 0; i < kMostStates && !joint; ++i) {  // a flood is looked at a little at a time
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
  const std::vector<std::string>& names_;
};

/// The log, which no flood fills.
class Log {
 public:
  explicit Log(const std::string& path) : file_(path), path_(path) {}

  /// Where the joints shall start: where the last state has them, if there is one; else at rest.
  StartPlace start(const DdsServerOptions& options, const std::vector<std::string>& names,
                   const std::vector<double>& rest) const {
    if (path_.empty()) return {rest, "posture at rest"};
    const std::optional<LoggedState> last = last_state(read_tail(path_, kTailBytes), names, path_);
    if (!last) return {rest, "posture at rest"};
    const int64_t now_us = system_us();
    check_age(*last, now_us, options.max_log_age_s, path_);
    check_whole(*last, changed_us(path_), path_);
    options.tell(fmt::format("{}: starts at its last state, of {}", path_, age_text(*last, now_us)));
    return {last->positions, path_};
  }

  void received(const ReceivedLine& line) {
    int64_t& left = line.receipt == Receipt::accepted ? accepted_left_ : refused_left_;
    if (left-- > 0) file_.append(received_line(line));
  }
  void state(const RobotState& state, int64_t time_us, const std::vector<std::string>& names) {
    const bool heartbeat = state.clock_us - heartbeat_us_ >= kHeartbeatUs;
    if (!heartbeat && state.position == last_.position && state.state == last_.state) return;
    if (heartbeat) accepted_left_ = refused_left_ = kLogLinesPerSecond;
    if (heartbeat) heartbeat_us_ = state.clock_us;
    file_.append(state_line(state, time_us, names));
    last_ = state;
  }
  int64_t lost() const { return file_.lost(); }
  const std::string& failure() const { return file_.failure(); }

 private:
  GrowingFile file_;
  std::string path_;
  int64_t accepted_left_ = kLogLinesPerSecond, refused_left_ = kLogLinesPerSecond;
  int64_t heartbeat_us_ = 0;
  RobotState last_;
};

template <typename Names, typename Counts>
std::string counted(int kinds, const Names& name, const Counts& count) {
  std::string text;
  for (int i = 0; i < kinds; ++i)
    if (count(i) > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count(i), name(i));
  return text.empty() ? "none" : text;
}

template <typename Port>
class Service {
 public:
  Service(Port& port, const DdsParticipant& participant, const DdsServerOptions& options, OtherServers& others,
          Log& log)
      : port_(port),
        options_(options),
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
        port_.server.gate().keep_only(port_.present());
        look_for_others();
        look_us = now_us + kLookAroundUs;
      }
      receive();
      now_us = steady_us();
      if (now_us < next_us) waitset_.wait((next_us - now_us) * 1000);
    }
    receive();  // what came before the end counts
    return {summary(), log_.lost()};
  }

 private:
  void receive() {
    port_.receive([&](const char* topic, Receipt receipt, const ros::Time& stamp, int64_t source_ns) {
      log_.received({system_us(), topic, receipt, nanoseconds(stamp), source_ns / 1000});
    });
  }
  void look_for_others() {
    const std::optional<std::string> joint = others_.heard();
    if (!joint) return;
    if (seen_others_++ == 0)
      options_.tell(
          fmt::format("{}: another process tells of {}, too: two servers of one robot?", Port::kName, *joint));
  }
  void tick(int64_t now_us) {
    if (now_us <= last_us_) return;
    if (states_sent_ > 0) longest_gap_us_ = std::max(longest_gap_us_, now_us - last_us_);
    last_us_ = now_us;
    const RobotState state = port_.server.tick(now_us);
    const int64_t time_us = system_us();
    states_.write({ros_time(time_us), Port::names(), state.position, state.velocity}, time_us * 1000);
    log_.state(state, time_us, Port::names());
    ++states_sent_;
  }

  std::string summary() const {
    const ReceiptCounts& receipts = port_.server.receipts();
    const Interventions& interventions = port_.server.interventions();
    std::string text = fmt::format(
        "{}: messages: {}; streams: {}; interventions: {}; states: {}, the longest gap {:.1f} ms", Port::kName,
        counted(
            kReceiptCount, [](int i) { return to_string(static_cast<Receipt>(i)); },
            [&](int i) { return receipts[static_cast<size_t>(i)]; }),
        port_.server.gate().owners(),
        counted(
            kInterventionCount, [](int i) { return to_string(static_cast<Intervention>(i)); },
            [&](int i) { return interventions[static_cast<Intervention>(i)]; }),
        states_sent_, static_cast<double>(longest_gap_us_) * 1e-3);
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
  OtherServers& others_;
  Log& log_;
  DdsWriter<ros::JointState> states_;
  DdsWaitset waitset_;
  int64_t last_us_ = 0, longest_gap_us_ = 0, states_sent_ = 0;
  int seen_others_ = 0;  ///< looks at which there was another
};

/// Throws Error if another server of these joints is there. It tells of them all the time, so a second is enough
/// for whoever the middleware finds.
void refuse_beside(OtherServers& others, const DdsServerOptions& options) {
  const int64_t end_us = steady_us() + kListenUs;
  while (steady_us() < end_us && !options.stopping()) {
    if (const std::optional<std::string> joint = others.heard())
      throw Error(fmt::format("DDS domain {}", options.domain), topics::kOwn.joint_states,
                  fmt::format("another process that tells of {}", *joint), "one server of a joint");
    std::this_thread::sleep_for(std::chrono::microseconds(kPeriodUs));
  }
}

/// `make_server`: the server of a side at a StartPlace.
template <typename Port, typename MakeServer>
DdsServerSummary serve(const DdsServerOptions& options, const std::vector<double>& rest,
                       const MakeServer& make_server) {
  Log log(options.log);  // first: nobody else writes on from here
  auto server = make_server(log.start(options, Port::names(), rest));
  const DdsParticipant participant(options.domain, options.access);
  OtherServers others(participant, Port::names());
  refuse_beside(others, options);
  Port port(participant, std::move(server));
  return Service(port, participant, options, others, log).run();
}

}  // namespace

DdsServerSummary serve_hand(const DdsServerOptions& options) {
  const std::vector<double> open(kShadowJointCount, 0.0);
  return serve<HandPort>(options, open, [&](const StartPlace& start) {
    return HandServer(options.limits, start.joints, start.source);
  });
}

DdsServerSummary serve_arm(const DdsServerOptions& options, const ArmSolver& solver,
                           const Eigen::Isometry3d& T_flange_wrist, const ArmJoints& rest) {
  return serve<ArmPort>(options, {rest.begin(), rest.end()}, [&](const StartPlace& start) {
    return ArmServer(options.limits, solver, T_flange_wrist, start.joints, start.source);
  });
}

}  // namespace glovebench
