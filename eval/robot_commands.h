#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/robot/command_guard.h"
#include "eval/measured_run.h"
#include "reports/commands.h"
#include "reports/timings.h"

namespace glovebench::eval {

/// The commands that hand and arm get for what a tracker said: as `track` sends them.
struct CommandStream {
  std::vector<RobotCommand> commands;  ///< in time order; one a result, less those that the guard drops
  std::vector<double> command_ms;      ///< processor time of mapping, arm and guard; one a result
  Interventions interventions;         ///< of the guard and the arm
};
CommandStream make_commands(std::span<const TrackResult> results, const RobotSetup& setup,
                            const CommandLimits& limits);
/// What a tracker would say that is never wrong.
std::vector<TrackResult> true_results(std::span<const HandFrame> truth);

/// Measures the commands of several passes over one movement against those that its truth gives. Commands belong
/// together by their time stamps. Errors are of commands that follow. Jerk is by four commands in a row that do,
/// and by those of the truth at the same times.
class CommandMeasurement {
 public:
  /// `frames`: of the pass, whether they have a command or not.
  void add(const CommandStream& stream, const CommandStream& of_truth, int frames);
  reports::CommandResult result() const;

 private:
  struct JerkSums {
    double joints = 0, position = 0;  ///< of squares
    int count = 0;                    ///< of third derivatives
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

/// How the robot commands of a run are made, and where they are written.
struct RobotOutput {
  std::string folder = {};  ///< JSON Lines, a file a run; empty: nowhere
  RobotSetup setup = {};
  CommandLimits limits = {};
  nlohmann::json configuration = {};  ///< all of that, for the results'; null: nothing is said of it
};
/// Makes and measures the commands of each experiment, and writes them as one set of files: adds what they came to
/// to the experiment's result, and the time from frame to command to its times. Both are of these runs.
void add_commands(reports::RunResult& result, reports::Timings& timings, std::span<const MeasuredRun> runs,
                  const RobotOutput& robot);

}  // namespace glovebench::eval
