// Numbers of an experiment's robot commands.

#include <numeric>

#include "reports/metrics/metric.h"
#include "reports/results.h"

namespace glovebench::reports {
namespace {

using Value = std::optional<double>;
using Commands = const CommandResult&;

/// `of` of the experiment's commands, if it has any.
template <auto of>
Value of_commands(const ExperimentResult& experiment) {
  return experiment.commands ? of(*experiment.commands) : Value();
}

constexpr std::string_view kFollowing = "mean over the commands that follow; lost frames give none";

template <Aggregate CommandErrors::*error>
Metric error_metric(int place, std::string_view key, std::string_view unit, std::string_view description,
                    std::string_view formula) {
  return {.key = key,
          .unit = unit,
          .description = description,
          .formula = formula,
          .place = place,
          .of_experiment = of_commands<[](Commands c) { return (c.errors.*error).mean; }>,
          .over = kFollowing};
}

template <Value Jerk::*part>
Metric jerk_metric(int place, std::string_view key, std::string_view unit, std::string_view of, int digits) {
  return {.key = key,
          .unit = unit,
          .description = of,
          .formula = "root mean square of the third derivative by time",
          .place = place,
          .of_experiment = of_commands<[](Commands c) { return c.jerk.*part; }>,
          .over = "all four successive commands that follow; lost frames give none",
          .digits = digits};
}

template <CommandState state>
Metric state_metric(int place, std::string_view key, std::string_view description) {
  return {.key = key,
          .unit = "commands",
          .description = description,
          .formula = "count",
          .place = place,
          .of_experiment = of_commands<[](Commands c) { return Value(c.sent[static_cast<size_t>(state)]); }>,
          .over = "commands that were sent",
          .digits = 0};
}

Value count_interventions(Commands commands) {
  double count = 0;
  for (const Intervention kind : all_values<Intervention>())
    count += static_cast<double>(commands.interventions[kind]);
  return count;
}

std::vector<Metric> stream_metrics() {
  return {{.key = "sent_commands",
           .unit = "commands",
           .description = "robot commands, after the guard",
           .formula = "count",
           .place = 3000,
           .of_experiment =
               of_commands<[](Commands c) { return Value(std::accumulate(c.sent.begin(), c.sent.end(), 0)); }>,
           .over = "all frames; lost ones give commands that hold",
           .digits = 0},
          {.key = "command_rate_hz",
           .unit = "Hz",
           .description = "commands a second, by time stamps",
           .formula = "1 / mean time between commands",
           .place = 3010,
           .of_experiment = of_commands<[](Commands c) { return c.rate_hz; }>,
           .over = "commands that were sent",
           .digits = 1},
          {.key = "command_gap_ms",
           .unit = "ms",
           .description = "longest time between commands, by time stamps",
           .formula = "maximum",
           .place = 3020,
           .of_experiment = of_commands<[](Commands c) { return c.longest_gap_ms; }>,
           .over = "commands that were sent",
           .digits = 0},
          {.key = "interventions",
           .unit = "interventions",
           .description = "commands that the guard changed or refused, or that the arm could not reach, by reason",
           .formula = "count",
           .place = 3060,
           .of_experiment = of_commands<count_interventions>,
           .over = "all commands",
           .digits = 0}};
}

}  // namespace

std::vector<Metric> command_metrics() {
  std::vector<Metric> all = {
      state_metric<CommandState::following>(3030, "following_commands", "commands that go to the targets"),
      state_metric<CommandState::holding>(3040, "holding_commands", "commands that stay, since the hand is lost"),
      state_metric<CommandState::stopped>(3050, "stopped_commands",
                                          "commands that stay, since it has been lost for 0.5 s"),
      error_metric<&CommandErrors::joints_deg>(3100, "command_joints_deg", "deg",
                                               "joints of the robot hand against the truth's command",
                                               "root mean square over the 24 joints of c' - c"),
      error_metric<&CommandErrors::position_mm>(3110, "command_position_mm", "mm",
                                                "origin of the hand against the truth's command", "|p' - p|"),
      error_metric<&CommandErrors::rotation_deg>(3120, "command_rotation_deg", "deg",
                                                 "rotation of the hand against the truth's command",
                                                 "angle of R'^T R"),
      error_metric<&CommandErrors::arm_deg>(3130, "command_arm_deg", "deg",
                                            "joints of the arm against the truth's command",
                                            "root mean square over the 7 joints of c' - c"),
      jerk_metric<&Jerk::joints_deg_s3>(3140, "jerk_joints_deg_s3", "deg/s3",
                                        "jerk of the 24 joints: less is smoother", 0),
      jerk_metric<&Jerk::position_m_s3>(3150, "jerk_position_m_s3", "m/s3",
                                        "jerk of the hand's origin: less is smoother", 1)};
  for (const Metric& metric : stream_metrics()) all.push_back(metric);
  return all;
}

}  // namespace glovebench::reports
