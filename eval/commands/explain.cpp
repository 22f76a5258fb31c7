#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

#include <filesystem>

#include "core/base/error.h"
#include "core/base/text.h"
#include "eval/commands/flags.h"
#include "eval/pictures.h"
#include "eval/program.h"
#include "eval/regression/baseline.h"
#include "render/pictures.h"
#include "trajectories/formats/format.h"

namespace glovebench::eval {
namespace {

using reports::ExperimentResult;
using trajectories::Trajectory;

/// Larger is worse, whatever is wrong: posture and pose together.
constexpr const char* kWorstBy = "vertex_error_mm";

struct Explain {
  CommonFlags common;
  std::string run_folder;
  std::string frame;  ///< number, "worst" or "worst:METRIC"
  std::string experiment_pattern;
  std::string trajectory;  ///< name or file
  std::string database_file;
  std::optional<uint64_t> seed;

  void run() {
    require_writable_files({{"--output", common.output, ".png"}});
    const std::string results_path = run_folder + "/results.json";
    const reports::RunResult results = load_finished_run(run_folder).results.result;
    const reports::WorstFrame chosen = chosen_frame(results, results_path);
    const auto truth = std::make_shared<const Trajectory>(load_truth(chosen.key));
    check_truth(results, chosen.key, *truth, results_path);
    common.left = truth->side == Side::left;
    if (!results.configuration.contains("tracker"))
      throw Error(results_path, "configuration", "no tracker", "a run of a tracker, whose stages can be shown");
    common.config_json = results.configuration.at("tracker");
    const TrackerConfig tracker = common.tracker_config();
    if (!shows_stages(tracker.method))
      throw Error(results_path, "method", tracker.method, "one that sees depth, whose stages can be shown");
    common.calibration_json = results.configuration.value("calibration", nlohmann::json());
    common.hand_json = results.configuration.value("hand", nlohmann::json());
    Workbench workbench = common.workbench();
    if (!database_file.empty()) workbench.add_database(database_file);
    const RunSpec spec{.trajectory = truth,
                       .subject = chosen.key.subject,
                       .noise = chosen.key.noise,
                       .seed = chosen.seed,
                       .database = chosen.key.database,
                       .tracker = tracker,
                       .appearance = chosen.key.appearance};
    check_database(results, chosen.key, *workbench.database(chosen.key.database), results_path);
    const int number = chosen.frame.frame;
    const std::string path = common.output.empty()
                                 ? fmt::format("{}/explain_{}_{}.png", run_folder, to_string(chosen.key), number)
                                 : common.output;
    render::write_png(path, explain_frame(workbench, spec, chosen.frame, hand_in_run(chosen)));
    if (common.quiet) return;
    const std::optional<double> error = chosen.frame[chosen.metric];
    fmt::print("{}: frame {}, seed {}, {} in the run\n{}\n", to_string(chosen.key), number, chosen.seed,
               error ? fmt::format("{} {:.1f}", chosen.metric, *error) : "lost", path);
  }

  /// Empty if the frame was lost or the folder has no estimates, as a baseline's.
  std::optional<HandFrame> hand_in_run(const reports::WorstFrame& chosen) const {
    const std::string path = run_folder + "/" + reports::estimates_file(chosen.key);
    if (!std::filesystem::exists(path)) return std::nullopt;
    return reports::find_hand(reports::read_estimates(path), chosen.seed, chosen.frame.frame);
  }

  /// A numbered frame is of the first experiment and seed that were asked for.
  reports::WorstFrame chosen_frame(const reports::RunResult& results, const std::string& path) const {
    const std::vector<const ExperimentResult*> experiments = find(results, path);
    if (frame == "worst") return worst(experiments, kWorstBy, path);
    const std::string prefix = "worst:";
    if (frame.starts_with(prefix)) return worst(experiments, checked_metric(frame.substr(prefix.size())), path);
    const reports::SeedRun& run = *seeds_of(*experiments.front(), path).front();
    return {experiments.front()->key, run.seed, numbered_frame(run.frames, path), kWorstBy};
  }

  reports::FrameRecord numbered_frame(const std::vector<reports::FrameRecord>& frames,
                                      const std::string& path) const {
    const std::optional<int> number = number_in<int>(frame);
    if (!number) throw Error("explain", "frame", quoted_excerpt(frame), "a number, worst or worst:METRIC");
    const auto found = std::ranges::find(frames, *number, &reports::FrameRecord::frame);
    if (found != frames.end()) return *found;
    throw Error(path, "frame", frame,
                frames.empty()
                    ? "worst: the run has none"
                    : fmt::format("one of the run's, {} to {}", frames.front().frame, frames.back().frame));
  }

  static std::string checked_metric(const std::string& metric) {
    std::vector<std::string> errors = reports::frame_metric_keys();
    std::erase(errors, "visible_percent");  // more of it is not worse
    if (std::ranges::count(errors, metric) == 0)
      throw Error("explain", "metric", quoted_excerpt(metric), one_of(errors, metric));
    return metric;
  }

  /// The frame with the largest value. Lost frames have no errors.
  reports::WorstFrame worst(const std::vector<const ExperimentResult*>& experiments, const std::string& metric,
                            const std::string& path) const {
    std::optional<reports::WorstFrame> worst;
    for (const ExperimentResult* experiment : experiments)
      for (const reports::SeedRun* run : seeds_of(*experiment, path))
        for (const reports::FrameRecord& record : run->frames)
          if (record[metric] && (!worst || *record[metric] > *worst->frame[metric]))
            worst = {experiment->key, run->seed, record, metric};
    if (!worst) throw Error(path, metric, "no frame with a value", "one or more");
    return *worst;
  }

  /// Experiments that match the pattern and are of the trajectory. If none is of a file's, all that match, so that
  /// its hash is the one thing to complain about. There is at least one.
  std::vector<const ExperimentResult*> find(const reports::RunResult& results, const std::string& path) const {
    std::vector<std::string> names;
    std::vector<const ExperimentResult*> matching, of_trajectory;
    const bool is_file = trajectories::is_trajectory_file(trajectory);
    const std::string name = is_file ? trajectories::load_trajectory(trajectory).name : trajectory;
    for (const ExperimentResult& experiment : results.experiments) {
      names.push_back(to_string(experiment.key));
      const bool matches =
          experiment_pattern.empty() || fnmatch(experiment_pattern.c_str(), names.back().c_str(), 0) == 0;
      if (!matches) continue;
      matching.push_back(&experiment);
      if (experiment.key.trajectory == name) of_trajectory.push_back(&experiment);
    }
    if (matching.empty())
      throw Error(path, "experiment", experiment_pattern.empty() ? "none" : experiment_pattern,
                  one_of(names, experiment_pattern));
    if (!of_trajectory.empty()) return of_trajectory;
    if (name.empty() || is_file) return matching;
    throw Error(path, "experiment", fmt::format("none of {}", name), one_of(names, name));
  }

  std::vector<const reports::SeedRun*> seeds_of(const ExperimentResult& experiment, const std::string& path) const {
    std::vector<uint64_t> seeds;
    std::vector<const reports::SeedRun*> runs;
    for (const reports::SeedRun& run : experiment.runs) {
      seeds.push_back(run.seed);
      if (!seed || *seed == run.seed) runs.push_back(&run);
    }
    if (!runs.empty()) return runs;
    throw Error(path, "noise seed", seed ? std::to_string(*seed) : "none",
                fmt::format("one of {}", fmt::join(seeds, ", ")));
  }

  Trajectory load_truth(const reports::ExperimentKey& key) const {
    if (trajectories::is_trajectory_file(trajectory)) return trajectories::load_trajectory(trajectory);
    if (const auto truth = find_truth(key)) return *truth;
    throw Error("--trajectory", "file", "none",
                "the one of " + key.trajectory + ", which the run was given as a file");
  }

  void check_truth(const reports::RunResult& results, const reports::ExperimentKey& key, const Trajectory& truth,
                   const std::string& path) const {
    const std::string name = truth_name(key);
    const auto it = results.inputs.truths.find(name);
    const std::string expected = it == results.inputs.truths.end() ? "nothing" : it->second;
    const std::string found = trajectories::hash(truth);
    const bool is_file = trajectories::is_trajectory_file(trajectory);
    if (found != expected)
      throw Error(
          path, "hash of " + name, found,
          expected + (is_file ? " (the truth of the run)" : ", that of the run: give its file by --trajectory"));
  }
  void check_database(const reports::RunResult& results, const reports::ExperimentKey& key,
                      const Database& database, const std::string& path) const {
    const auto it = results.inputs.databases.find(key.database);
    const std::string expected = it == results.inputs.databases.end() ? "nothing" : it->second;
    if (database.content_hash() != expected)
      throw Error(path, "hash of " + key.database, database.content_hash(),
                  expected + (database_file.empty() ? ", that of the run: give its file by --database"
                                                    : " (the database of the run)"));
  }
};

}  // namespace

void add_explain(Command program) {
  const Command command = program.subcommand(
      "explain", "Show every stage of one frame of a run as a picture: images, labels, matches, alignment.");
  const auto state = std::make_shared<Explain>();
  command.option("run", state->run_folder, "folder of a report").required().existing_folder();
  command
      .option(
          "frame", state->frame,
          fmt::format("its number from 0, or worst (by {}), or worst:METRIC (`glovebench list metrics`)", kWorstBy))
      .required();
  command.option(
      "--experiment", state->experiment_pattern,
      "e.g. Tr4_DB_open_power_recorded_subject1_gradient_1 or 'Tr4_*' (shell wildcards); for worst, in all "
      "of them [a number: the first of the run]");
  command.option(
      "--trajectory", state->trajectory,
      "of the experiment: a name (Tr4; side_3 of a family), or the file that the run was given (*.json)");
  command.option("--database", state->database_file, "file of the database, if it is none of the program's")
      .existing_file();
  command.option("--seed", state->seed, "noise seed of the experiment [its first]");
  state->common.add_output(command, "picture to write (*.png) [in the run's folder]");
  state->common.add_machine(command);
  command.runs([state] { state->run(); });
}

}  // namespace glovebench::eval
