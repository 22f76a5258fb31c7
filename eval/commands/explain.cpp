#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "eval/commands/flags.h"
#include "eval/pictures.h"
#include "eval/program.h"
#include "eval/regression/baseline.h"
#include "render/pictures.h"
#include "reports/results_json.h"
#include "trajectories/formats/format.h"

namespace glovebench::eval {
namespace {

using reports::ExperimentResult;
using trajectories::Trajectory;

struct Explain {
  CommonFlags common;
  std::string run_folder;
  int frame = 0;
  std::string experiment_name;
  std::string trajectory_file;
  std::string database_file;
  std::optional<uint64_t> seed;

  void run() {
    const std::string results_path = run_folder + "/results.json";
    const reports::RunResult results = load_finished_run(run_folder).results.result;
    const ExperimentResult& experiment = find(results, results_path);
    const auto truth = std::make_shared<const Trajectory>(load_truth(experiment.key));
    check_truth(results, experiment.key, *truth, results_path);
    common.left = truth->side == Side::left;
    common.config_json = results.configuration.at("tracker");
    common.calibration_json = results.configuration.value("calibration", nlohmann::json());
    common.hand_json = results.configuration.value("hand", nlohmann::json());
    Workbench workbench = common.workbench();
    if (!database_file.empty()) workbench.add_database(database_file);
    const RunSpec spec{.trajectory = truth,
                       .subject = experiment.key.subject,
                       .noise = experiment.key.noise,
                       .seed = seed_of(experiment, results_path),
                       .database = experiment.key.database,
                       .tracker = common.tracker_config()};
    check_database(results, experiment.key, *workbench.database(experiment.key.database), results_path);
    const std::string path = common.output.empty()
                                 ? fmt::format("{}/explain_{}_{}.png", run_folder, to_string(experiment.key), frame)
                                 : common.output;
    render::write_png(path, explain_frame(workbench, spec, frame));
    if (!common.quiet) fmt::print("{}\n", path);
  }

  const ExperimentResult& find(const reports::RunResult& results, const std::string& path) const {
    std::vector<std::string> names;
    for (const ExperimentResult& experiment : results.experiments) {
      names.push_back(to_string(experiment.key));
      if (experiment_name.empty() || experiment_name == names.back()) return experiment;
    }
    throw Error(path, "experiment", experiment_name.empty() ? "none" : experiment_name,
                one_of(names, experiment_name));
  }

  uint64_t seed_of(const ExperimentResult& experiment, const std::string& path) const {
    std::vector<uint64_t> seeds;
    for (const reports::SeedRun& run : experiment.runs) {
      seeds.push_back(run.seed);
      if (!seed || *seed == run.seed) return run.seed;
    }
    throw Error(path, "noise seed", seed ? std::to_string(*seed) : "none",
                fmt::format("one of {}", fmt::join(seeds, ", ")));
  }

  Trajectory load_truth(const reports::ExperimentKey& key) const {
    if (!trajectory_file.empty()) return trajectories::load_trajectory(trajectory_file);
    if (const auto truth = find_truth(key)) return *truth;
    throw Error("--trajectory", "file", "none",
                "the one of " + key.trajectory + ", which the run was given as a file");
  }

  static void check_truth(const reports::RunResult& results, const reports::ExperimentKey& key,
                          const Trajectory& truth, const std::string& path) {
    const std::string name = truth_name(key);
    const auto it = results.inputs.truths.find(name);
    const std::string expected = it == results.inputs.truths.end() ? "nothing" : it->second;
    const std::string found = trajectories::hash(truth);
    if (found != expected) throw Error(path, "hash of " + name, found, expected + " (the truth of the run)");
  }
  static void check_database(const reports::RunResult& results, const reports::ExperimentKey& key,
                             const Database& database, const std::string& path) {
    const auto it = results.inputs.databases.find(key.database);
    const std::string expected = it == results.inputs.databases.end() ? "nothing" : it->second;
    if (database.content_hash() != expected)
      throw Error(path, "hash of " + key.database, database.content_hash(),
                  expected + " (the database of the run)");
  }
};

}  // namespace

void add_explain(Command program) {
  const Command command = program.subcommand(
      "explain", "Show every stage of one frame of a run as a picture: images, labels, matches, alignment.");
  const auto state = std::make_shared<Explain>();
  command.option("run", state->run_folder, "folder of a report").required().existing_folder();
  command.option("frame", state->frame, "number of the frame, from 0").required();
  command.option("--experiment", state->experiment_name,
                 "e.g. Tr4_DB_open_power_recorded_subject1_gradient_1 [the first of the run]");
  command.option("--trajectory", state->trajectory_file, "file of the truth, if it is none of Tr1..Tr5")
      .existing_file();
  command.option("--database", state->database_file, "file of the database, if it is none of the program's")
      .existing_file();
  command.option("--seed", state->seed, "noise seed of the experiment [its first]");
  state->common.add_output(command, "picture to write (*.png) [in the run's folder]");
  state->common.add_machine(command);
  command.runs([state] { state->run(); });
}

}  // namespace glovebench::eval
