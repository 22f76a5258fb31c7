#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/robot/command_limits.h"
#include "eval/measured_run.h"
#include "reports/commands.h"
#include "reports/timings.h"

namespace glovebench::eval {

/// Commands as `track` sends them.
struct CommandStream {
  std::vector<RobotCommand> commands;  ///< in time order, at most one per result
  std::vector<double> command_ms;      ///< processor time by result
  Interventions interventions;
};
CommandStream make_commands(std::span<const TrackResult> results, const RobotSetup& setup,
                            const CommandLimits& limits);
std::vector<TrackResult> true_results(std::span<const HandFrame> truth);

/// Compares commands with the truth's at equal time stamps. Errors are of `following` commands. Jerk needs four in
/// a row.
class CommandMeasurement {
 public:
  /// `frames`: number of all frames.
  void add(const CommandStream& stream, const CommandStream& of_truth, int frames);
  reports::CommandResult result() const;

 private:
  struct JerkSums {
    double joints = 0, position = 0;  ///< sums of squares
    int count = 0;
    void add(std::span<const RobotCommand* const, 4> commands);
    reports::Jerk rms() const;
  };
  struct Errors {
    std::vector<double> joints_deg, position_mm, rotation_deg, arm_deg;
    void add(const RobotTargets& targets, const RobotTargets& of_truth);
  };

  reports::CommandResult counts_;
  std::vector<double> gaps_s_;
  Errors errors_;
  JerkSums jerk_, truth_jerk_;
};

struct RobotOutput {
  std::string folder = {};  ///< for JSON Lines, one file per run; empty: none
  RobotSetup setup = {};
  CommandLimits limits = {};
  nlohmann::json configuration = {};  ///< for the results; null: none
};
/// Makes and writes the commands of `runs`. Adds their errors to `result` and latencies to `timings`.
void add_commands(reports::RunResult& result, reports::Timings& timings, std::span<const MeasuredRun> runs,
                  const RobotOutput& robot);

}  // namespace glovebench::eval
