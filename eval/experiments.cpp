#include "eval/experiments.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <map>
#include <tuple>

#include "core/base/check.h"
#include "core/base/file_set.h"
#include "core/base/hash.h"
#include "core/robot/json_lines_sink.h"
#include "eval/measured_run.h"
#include "eval/page_material.h"
#include "eval/program_info.h"
#include "eval/robot_commands.h"
#include "eval/sequence_metrics.h"
#include "eval/share.h"
#include "reports/report.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

using reports::ExperimentKey;
using trajectories::Trajectory;

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// What the process took since then.
void note_resources(reports::Timings& timings, std::chrono::steady_clock::time_point start) {
  timings.peak_memory_mb = peak_memory_mb();
  timings.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The runs of one experiment: one a seed.
struct Gathered {
  ExperimentKey key;
  std::vector<const MeasuredRun*> runs;
};

std::vector<Gathered> gather(const std::vector<MeasuredRun>& runs) {
  std::vector<Gathered> experiments;
  for (const MeasuredRun& each : runs) {
    const ExperimentKey key = key_of(each.run.spec);
    auto it = std::ranges::find(experiments, key, &Gathered::key);
    if (it == experiments.end()) it = experiments.insert(it, {key, {}});
    for (const MeasuredRun* other : it->runs)
      check(other->run.spec.seed != each.run.spec.seed, "a seed counts once");
    it->runs.push_back(&each);
  }
  return experiments;
}

std::optional<double> mean_present(const std::vector<std::optional<double>>& values) {
  std::vector<double> present;
  for (const auto& value : values) {
    if (value) present.push_back(*value);
  }
  return reports::mean(present);
}

/// Each seed's sequence is measured by itself; the means over the seeds stand in the report.
reports::SequenceMetrics measure_sequences(const Gathered& experiment) {
  std::vector<std::optional<double>> position, rotation, latency;
  for (const MeasuredRun* each : experiment.runs) {
    const reports::SequenceMetrics m = measure_sequence(each->run.answers, frames_of(each->run.spec));
    position.push_back(m.jitter_position_mm);
    rotation.push_back(m.jitter_rotation_deg);
    latency.push_back(m.latency_frames);
  }
  return {mean_present(position), mean_present(rotation), mean_present(latency)};
}

reports::ExperimentResult evaluate(const Gathered& experiment) {
  std::vector<reports::SeedRun> runs;
  std::vector<double> joint_errors;
  size_t keypoints = 0;
  for (const MeasuredRun* each : experiment.runs) {
    reports::SeedRun run{each->run.spec.seed, {}};
    for (const reports::FrameErrors& errors : each->errors) {
      run.frames.push_back(errors.record);
      joint_errors.insert(joint_errors.end(), errors.joint_errors_mm.begin(), errors.joint_errors_mm.end());
      keypoints += kForearmJoint;
    }
    runs.push_back(std::move(run));
  }
  return reports::summarize(experiment.key, std::move(runs), reports::pck_curve(joint_errors, keypoints),
                            measure_sequences(experiment));
}

reports::ExperimentTiming timing_of(const Gathered& experiment) {
  reports::ExperimentTiming timing{experiment.key, 0, {}};
  for (const MeasuredRun* each : experiment.runs) {
    for (const reports::StageTiming& stage : each->run.stages) {
      auto it = std::find_if(timing.stages.begin(), timing.stages.end(),
                             [&](const reports::StageTiming& s) { return s.stage == stage.stage; });
      if (it == timing.stages.end()) it = timing.stages.insert(it, {stage.stage, {}});
      it->frame_ms.insert(it->frame_ms.end(), stage.frame_ms.begin(), stage.frame_ms.end());
      for (const double ms : stage.frame_ms) timing.wall_s += ms / 1000;
    }
  }
  return timing;
}

/// The robot commands of the experiments, beside those that their truths give.
class Robot {
 public:
  explicit Robot(const RobotOutput& output) : output_(output) {
    if (!output_.folder.empty()) files_.emplace(output_.folder);
  }

  /// Adds the times from frame to command to the experiment's.
  reports::CommandResult command(const Gathered& experiment, reports::ExperimentTiming& timing) {
    CommandMeasurement measurement;
    for (const MeasuredRun* each : experiment.runs) {
      const Run& run = each->run;
      const CommandStream stream = make_commands(run.answers, output_.setup, output_.limits);
      measurement.add(stream, of_truth(run.spec), static_cast<int>(run.answers.size()));
      for (size_t f = 0; f < run.answers.size(); ++f)
        timing.command_ms.push_back(run.frame_ms[f] + stream.command_ms[f]);
      if (files_)
        files_->add(fmt::format("{}_seed{}.jsonl", to_string(experiment.key), run.spec.seed), json_lines(stream));
    }
    return measurement.result();
  }
  /// After the last experiment.
  void commit() {
    if (files_) files_->commit();
  }

 private:
  static std::string json_lines(const CommandStream& stream) {
    std::string lines;
    for (const RobotCommand& command : stream.commands) lines += to_json_line(command) + "\n";
    return lines;
  }

  /// Databases, noises and seeds share a truth.
  const CommandStream& of_truth(const RunSpec& spec) {
    const auto key = std::tuple(spec.trajectory, spec.frames.first, spec.frames.count);
    const auto [it, is_new] = of_truth_.try_emplace(key);
    if (is_new) it->second = make_commands(true_results(frames_of(spec)), output_.setup, output_.limits);
    return it->second;
  }

  const RobotOutput& output_;
  std::optional<WholeFiles> files_;
  std::map<std::tuple<std::shared_ptr<const Trajectory>, int, std::optional<int>>, CommandStream> of_truth_;
};

reports::ExperimentEstimates estimates_of(const Gathered& experiment) {
  reports::ExperimentEstimates estimates{experiment.key, {}};
  for (const MeasuredRun* each : experiment.runs) {
    int frame = each->run.spec.frames.first;
    for (const TrackResult& r : each->run.answers) {
      estimates.estimates.push_back(
          {each->run.spec.seed, frame++, r.timestamp_us, r.status, r.posture, r.T_camera_hand});
    }
  }
  return estimates;
}

reports::RunResult assemble(const Plan& plan, const std::vector<Gathered>& experiments, Workbench& workbench) {
  reports::RunResult result;
  result.protocol = reports::make_protocol("by time stamp, exact");
  for (const RunSpec& spec : plan.specs) {
    result.inputs.truths[truth_name(key_of(spec))] = trajectories::hash(*spec.trajectory);
    result.inputs.databases[spec.database] = workbench.database(spec.database)->content_hash();
  }
  result.inputs.hand_model = workbench.model()->hash();
  const auto color_table = workbench.color_table(plan.tracker.segmentation.color_space);
  result.inputs.color_table = hash_bytes(std::as_bytes(std::span(color_table->labels())));
  result.suite = plan.suite;
  result.program_version = program_info().version;
  result.commit = program_info().commit;
  result.configuration = {{"tracker", to_json(plan.tracker)}};
  if (plan.quick) result.configuration["quick"] = true;
  if (const auto cameras = to_json(workbench.calibration()); cameras != to_json(synthetic_calibration()))
    result.configuration["calibration"] = cameras;
  for (const Gathered& experiment : experiments) result.experiments.push_back(evaluate(experiment));
  return result;
}

}  // namespace

Plan plan_figure4(const TrackerConfig& tracker, const Figure4Options& options) {
  const std::string folder = trajectory_folder();
  Plan plan{tracker, {}};
  const auto& names = options.trajectories.empty() ? trajectories::ground_truth_names() : options.trajectories;
  for (const reports::NoiseSetting& noise : options.noises) {
    for (const std::string& name : names) {
      const std::vector<std::string> databases = trajectories::databases_of(name);
      const auto recorded = std::make_shared<const Trajectory>(trajectories::recorded_trajectory(folder, name));
      const auto source = std::make_shared<const Trajectory>(trajectories::source_trajectory(folder, name));
      const auto add = [&](const std::shared_ptr<const Trajectory>& truth, int subject, uint64_t seed) {
        for (const std::string& database : databases)
          plan.specs.push_back({truth, options.frames, subject, noise, seed, database, tracker});
      };
      for (const uint64_t seed : options.seeds) add(recorded, 1, seed);
      for (const uint64_t seed : options.seeds) add(source, 1, seed);
      for (const uint64_t seed : options.seeds) add(source, 2, seed);
    }
  }
  return plan;
}

Outcome run_experiments(Workbench& workbench, const Plan& plan, const RobotOutput& robot, RunStore* store) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<MeasuredRun> runs =
      measure(workbench, execute(workbench, plan.specs, {workbench.config().threads, store}));
  const std::vector<Gathered> experiments = gather(runs);
  Outcome outcome{assemble(plan, experiments, workbench), host_timings(workbench.config().threads), {}};
  if (!robot.configuration.is_null()) outcome.result.configuration["robot"] = robot.configuration;
  Robot commanded(robot);
  for (size_t e = 0; e < experiments.size(); ++e) {
    outcome.timings.experiments.push_back(timing_of(experiments[e]));
    outcome.result.experiments[e].commands = commanded.command(experiments[e], outcome.timings.experiments.back());
    outcome.estimates.push_back(estimates_of(experiments[e]));
  }
  commanded.commit();
  note_resources(outcome.timings, start);
  return outcome;
}

Outcome run_into_folder(Workbench& workbench, const Plan& plan, const RobotOutput& robot, const std::string& folder,
                        const RunStudies& run_studies) {
  const auto start = std::chrono::steady_clock::now();
  RunStore store(folder);
  Outcome outcome = run_experiments(workbench, plan, robot, &store);
  if (run_studies) outcome.result.studies = run_studies(store);
  note_resources(outcome.timings, start);
  reports::write_report(folder, outcome.result, outcome.timings, page_material(workbench, plan, outcome),
                        outcome.estimates);
  store.finish();
  return outcome;
}

}  // namespace glovebench::eval
