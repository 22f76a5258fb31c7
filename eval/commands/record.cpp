#include <fmt/format.h>

#include "core/base/error.h"
#include "eval/commands/flags.h"
#include "eval/program.h"
#include "eval/record.h"
#include "trajectories/catalog.h"
#include "trajectories/formats/format.h"

namespace glovebench::eval {
namespace {

struct Record {
  CommonFlags common;
  std::string trajectory;
  std::string database;

  void run() {
    if (!trajectories::is_trajectory_file(common.output))
      throw Error("--output", "file name", common.output, "the ending .json, by which it is read again");
    const bool is_file = trajectories::is_trajectory_file(trajectory);
    if (is_file) require_different_files({{"--trajectory", trajectory}, {"--output", common.output}});
    const trajectories::Trajectory source =
        is_file ? load_truth(trajectory, {}) : load_truth(trajectory, reports::TruthKind::source);
    if (is_file && database.empty())
      throw Error("--database", "name", "nothing", "a database; recording a file needs one");
    const std::string name = !database.empty() ? database : trajectories::databases_of(trajectory).front();
    common.warn_of_units(source);
    common.left = source.side == Side::left;
    Workbench workbench = common.workbench();
    const trajectories::Trajectory recorded =
        record_truth(workbench, source, name, common.tracker_config(), common.seed);
    trajectories::write_trajectory(recorded, common.output);
    if (common.quiet) return;
    fmt::print("{}: {} frames, recorded with {}, hash {}\n", common.output, recorded.frames.size(), name,
               trajectories::hash(recorded));
  }
};

}  // namespace

void add_record(Command program) {
  const Command command = program.subcommand(
      "record",
      "Make a recorded truth, the paper's protocol: a movement is tracked, and what the tracker said becomes a "
      "ground truth of its own.");
  const auto state = std::make_shared<Record>();
  state->common.add_output(command, "trajectory file to write (*.json)").required();
  command.option("--trajectory", state->trajectory, "source: Tr1..Tr5 or a file (*.json)").required();
  command.option("--database", state->database, "recorded with [of Tr1..Tr5: the one with just its grasp]");
  state->common.add_tracker(command);
  state->common.add_seed(command);
  state->common.add_cameras(command);
  state->common.add_machine(command);
  command.runs([state] { state->run(); });
}

}  // namespace glovebench::eval
