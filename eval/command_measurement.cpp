#include "eval/command_measurement.h"

#include <fmt/format.h>

#include <map>
#include <tuple>

#include "core/base/error.h"
#include "core/base/file_set.h"
#include "core/base/math.h"
#include "core/robot/command_guard.h"
#include "core/robot/robot_command.h"
#include "eval/experiment.h"
#include "eval/threads.h"

namespace glovebench::eval {
namespace {

using JointVector = Eigen::Map<const Eigen::Vector<double, kShadowJointCount>>;

template <size_t Count>
double rms_difference_deg(const std::array<double, Count>& a, const std::array<double, Count>& b) {
  const Eigen::Map<const Eigen::ArrayXd> values(a.data(), Count), others(b.data(), Count);
  return degrees_from_radians(std::sqrt((values - others).square().mean()));
}

double seconds_between(const RobotCommand& before, const RobotCommand& after) {
  return static_cast<double>(after.timestamp_us - before.timestamp_us) * 1e-6;
}

/// Third derivative in the middle of four commands by divided differences; exact for cubics at any steps.
template <typename Value>
auto third_derivative(std::span<const RobotCommand* const, 4> commands, const Value& value) {
  std::array<std::decay_t<decltype(value(*commands[0]))>, 4> d;
  for (size_t i = 0; i < 4; ++i) d[i] = value(*commands[i]);
  for (size_t order = 1; order < 4; ++order)
    for (size_t i = 0; i + order < 4; ++i)
      d[i] = (d[i + 1] - d[i]) / seconds_between(*commands[i], *commands[i + order]);
  return (6 * d[0]).eval();
}

/// The command of that time, or null; moves `from` up to it.
const RobotCommand* command_at(int64_t timestamp_us, std::span<const RobotCommand> commands, size_t& from) {
  while (from < commands.size() && commands[from].timestamp_us < timestamp_us) ++from;
  return from < commands.size() && commands[from].timestamp_us == timestamp_us ? &commands[from] : nullptr;
}

std::string json_lines(const CommandStream& stream) {
  std::string lines;
  for (const RobotCommand& command : stream.commands) lines += to_json_line(command) + "\n";
  return lines;
}

/// Commands from truths, shared by databases, noises and seeds.
class TrueCommands {
 public:
  explicit TrueCommands(const RobotOutput& robot) : robot_(robot) {}

  const CommandStream& of(const RunSpec& spec) {
    const auto key = std::tuple(spec.trajectory, spec.frames.first, spec.frames.count);
    const auto [it, is_new] = streams_.try_emplace(key);
    if (is_new) it->second = make_commands(true_results(frames_of(spec)), robot_.setup, robot_.limits);
    return it->second;
  }

 private:
  const RobotOutput& robot_;
  std::map<std::tuple<std::shared_ptr<const trajectories::Trajectory>, int, std::optional<int>>, CommandStream>
      streams_;
};

}  // namespace

CommandStream make_commands(std::span<const TrackResult> results, const RobotSetup& setup,
                            const CommandLimits& limits) {
  RobotCommander commander(setup);
  CommandGuard guard(limits);
  CommandStream stream;
  for (const TrackResult& result : results) {
    const double start = thread_time_ms();
    std::optional<RobotCommand> safe = guard.guard(commander.command(result));
    stream.command_ms.push_back(thread_time_ms() - start);
    if (safe) stream.commands.push_back(*std::move(safe));
  }
  stream.interventions = guard.interventions();
  return stream;
}

std::vector<TrackResult> true_results(std::span<const HandFrame> truth) {
  std::vector<TrackResult> results;
  for (const HandFrame& frame : truth) {
    TrackResult& result = results.emplace_back();
    result.timestamp_us = frame.timestamp_us;
    result.status = TrackStatus::tracked;
    result.posture = frame.posture;
    result.T_camera_hand = frame.T_camera_hand;
  }
  return results;
}

void CommandMeasurement::Errors::add(const RobotTargets& targets, const RobotTargets& of_truth) {
  joints_deg.push_back(rms_difference_deg(targets.hand.joints, of_truth.hand.joints));
  position_mm.push_back(1e3 * (targets.T_base_hand.translation() - of_truth.T_base_hand.translation()).norm());
  rotation_deg.push_back(
      degrees_from_radians(angle_between(targets.T_base_hand.linear(), of_truth.T_base_hand.linear())));
  if (targets.arm && of_truth.arm) arm_deg.push_back(rms_difference_deg(*targets.arm, *of_truth.arm));
}

void CommandMeasurement::JerkSums::add(std::span<const RobotCommand* const, 4> commands) {
  joints += third_derivative(commands,
                             [](const RobotCommand& c) -> Eigen::Vector<double, kShadowJointCount> {
                               return JointVector(c.targets->hand.joints.data());
                             })
                .squaredNorm() /
            kShadowJointCount;
  position += third_derivative(commands, [](const RobotCommand& c) -> Eigen::Vector3d {
                return c.targets->T_base_hand.translation();
              }).squaredNorm();
  ++count;
}

reports::Jerk CommandMeasurement::JerkSums::rms() const {
  if (count == 0) return {};
  return {degrees_from_radians(std::sqrt(joints / count)), std::sqrt(position / count)};
}

void CommandMeasurement::add(const CommandStream& stream, const CommandStream& of_truth, int frames) {
  counts_.frames += frames;
  counts_.interventions.add(stream.interventions);
  std::vector<const RobotCommand*> following,
      of_truths;  // successive `following` commands, and the truth's at their times
  size_t at = 0;
  for (size_t i = 0; i < stream.commands.size(); ++i) {
    const RobotCommand& command = stream.commands[i];
    ++counts_.sent[static_cast<size_t>(command.state)];
    if (i > 0) gaps_s_.push_back(seconds_between(stream.commands[i - 1], command));
    const RobotCommand* truth = command_at(command.timestamp_us, of_truth.commands, at);
    if (command.state != CommandState::following || !truth || !truth->targets) {
      following.clear();
      of_truths.clear();
      continue;
    }
    errors_.add(*command.targets, *truth->targets);
    following.push_back(&command);
    of_truths.push_back(truth);
    if (following.size() < 4) continue;
    jerk_.add(std::span(following).last<4>());
    truth_jerk_.add(std::span(of_truths).last<4>());
  }
}

reports::CommandResult CommandMeasurement::result() const {
  reports::CommandResult result = counts_;
  if (const std::optional<double> step = reports::mean(gaps_s_)) {
    result.rate_hz = 1 / *step;
    result.longest_gap_ms = 1e3 * std::ranges::max(gaps_s_);
  }
  result.errors = {reports::aggregate(errors_.joints_deg), reports::aggregate(errors_.position_mm),
                   reports::aggregate(errors_.rotation_deg), reports::aggregate(errors_.arm_deg)};
  result.jerk = jerk_.rms();
  result.truth_jerk = truth_jerk_.rms();
  return result;
}

void add_commands(reports::RunResult& result, reports::Timings& timings, std::span<const MeasuredRun> runs,
                  const RobotOutput& robot) {
  const std::vector<Experiment> experiments = experiments_of(runs);
  check(result.experiments.size() == experiments.size() && timings.experiments.size() == experiments.size(),
        "results and times are of these runs");
  if (!robot.configuration.is_null()) result.configuration["robot"] = robot.configuration;
  TrueCommands true_commands(robot);
  std::optional<WholeFiles> files;
  if (!robot.folder.empty()) files.emplace(robot.folder);
  for (size_t e = 0; e < experiments.size(); ++e) {
    if (!has_hands(experiments[e])) continue;
    CommandMeasurement measurement;
    for (const MeasuredRun* each : experiments[e].runs) {
      const Run& run = each->run;
      const CommandStream stream = make_commands(run.answers, robot.setup, robot.limits);
      measurement.add(stream, true_commands.of(run.spec), static_cast<int>(run.answers.size()));
      for (size_t f = 0; f < run.answers.size(); ++f)
        timings.experiments[e].command_ms.push_back(run.frame_ms[f] + stream.command_ms[f]);
      if (files)
        files->add(fmt::format("{}_seed{}.jsonl", to_string(experiments[e].key), run.spec.seed),
                   json_lines(stream));
    }
    result.experiments[e].commands = measurement.result();
  }
  if (files) files->commit();
}

}  // namespace glovebench::eval
