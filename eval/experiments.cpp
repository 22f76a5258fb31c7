#include "eval/experiments.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <map>
#include <tuple>

#include "core/base/error.h"
#include "core/base/file_set.h"
#include "core/base/hash.h"
#include "core/robot/json_lines_sink.h"
#include "eval/page_material.h"
#include "eval/program_info.h"
#include "eval/replay_all.h"
#include "eval/robot_commands.h"
#include "eval/sequence_metrics.h"
#include "eval/share.h"
#include "reports/report.h"
#include "trajectories/catalog.h"

namespace glovebench::eval {
namespace {

using reports::ExperimentKey;
using reports::TruthKind;
using trajectories::Trajectory;
using trajectories::TrajectoryKind;

TruthKind truth_kind(const Trajectory& trajectory) {
  return trajectory.kind == TrajectoryKind::recorded ? TruthKind::recorded : TruthKind::source;
}

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

/// The passes of one experiment: one a seed.
struct Gathered {
  ExperimentKey key;
  std::vector<const Replay*> replays;
  std::vector<const TrackedReplay*> passes;
};

std::vector<Gathered> gather(const Plan& plan, const std::vector<TrackedReplays>& outputs) {
  std::vector<Gathered> experiments;
  for (size_t r = 0; r < plan.replays.size(); ++r) {
    for (const TrackedReplay& pass : outputs[r]) {
      const ExperimentKey key = key_of(plan.replays[r], pass.database);
      auto it =
          std::find_if(experiments.begin(), experiments.end(), [&](const Gathered& g) { return g.key == key; });
      if (it == experiments.end()) it = experiments.insert(it, {key, {}, {}});
      for (const Replay* other : it->replays) check(other->seed != plan.replays[r].seed, "a seed counts once");
      it->replays.push_back(&plan.replays[r]);
      it->passes.push_back(&pass);
    }
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
  for (size_t i = 0; i < experiment.passes.size(); ++i) {
    const reports::SequenceMetrics m =
        measure_sequence(experiment.passes[i]->results, frames_of(*experiment.replays[i]));
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
  for (size_t i = 0; i < experiment.passes.size(); ++i) {
    reports::SeedRun run{experiment.replays[i]->seed, {}};
    for (const reports::FrameErrors& errors : experiment.passes[i]->errors) {
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
  for (const TrackedReplay* pass : experiment.passes) {
    for (const reports::StageTiming& stage : pass->stages) {
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
    for (size_t i = 0; i < experiment.passes.size(); ++i) {
      const TrackedReplay& pass = *experiment.passes[i];
      const CommandStream stream = make_commands(pass.results, output_.setup, output_.limits);
      measurement.add(stream, of_truth(*experiment.replays[i]), static_cast<int>(pass.results.size()));
      for (size_t f = 0; f < pass.results.size(); ++f)
        timing.command_ms.push_back(pass.frame_ms[f] + stream.command_ms[f]);
      if (files_)
        files_->add(fmt::format("{}_seed{}.jsonl", to_string(experiment.key), experiment.replays[i]->seed),
                    json_lines(stream));
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
  const CommandStream& of_truth(const Replay& replay) {
    const auto key = std::tuple(replay.truth, replay.range.first, replay.range.count);
    const auto [it, is_new] = of_truth_.try_emplace(key);
    if (is_new) it->second = make_commands(true_results(frames_of(replay)), output_.setup, output_.limits);
    return it->second;
  }

  const RobotOutput& output_;
  std::optional<WholeFiles> files_;
  std::map<std::tuple<std::shared_ptr<const Trajectory>, int, std::optional<int>>, CommandStream> of_truth_;
};

reports::ExperimentEstimates estimates_of(const Gathered& experiment) {
  reports::ExperimentEstimates estimates{experiment.key, {}};
  for (size_t i = 0; i < experiment.passes.size(); ++i) {
    int frame = experiment.replays[i]->range.first;
    for (const TrackResult& r : experiment.passes[i]->results) {
      estimates.estimates.push_back(
          {experiment.replays[i]->seed, frame++, r.timestamp_us, r.status, r.posture, r.T_camera_hand});
    }
  }
  return estimates;
}

reports::RunResult assemble(const Plan& plan, const std::vector<Gathered>& experiments, Workbench& workbench) {
  reports::RunResult result;
  result.protocol = reports::make_protocol("by time stamp, exact");
  for (const Replay& replay : plan.replays) {
    for (const std::string& name : replay.databases) {
      result.inputs.truths[truth_name(key_of(replay, name))] = trajectories::hash(*replay.truth);
      result.inputs.databases[name] = workbench.database(name)->content_hash();
    }
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

ExperimentKey key_of(const Replay& replay, const std::string& database) {
  return {replay.truth->name, database, truth_kind(*replay.truth), replay.subject, replay.noise};
}

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
        plan.replays.push_back({truth, subject, noise, seed, databases, options.frames, tracker});
      };
      for (const uint64_t seed : options.seeds) add(recorded, 1, seed);
      for (const uint64_t seed : options.seeds) add(source, 1, seed);
      for (const uint64_t seed : options.seeds) add(source, 2, seed);
    }
  }
  return plan;
}

void prepare(Workbench& workbench, const Plan& plan) {
  prepare(workbench, plan.replays);
}

Outcome run_experiments(Workbench& workbench, const Plan& plan, const RobotOutput& robot,
                        const RunFolder* run_folder) {
  const auto start = std::chrono::steady_clock::now();
  prepare(workbench, plan);
  const std::vector<TrackedReplays> outputs =
      replay_all(workbench, plan.replays, workbench.config().threads, run_folder);
  const std::vector<Gathered> experiments = gather(plan, outputs);
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
  RunFolder run_folder(folder);
  prepare(workbench, plan);
  run_folder.begin();
  Outcome outcome = run_experiments(workbench, plan, robot, &run_folder);
  if (run_studies) outcome.result.studies = run_studies(run_folder);
  note_resources(outcome.timings, start);
  reports::write_report(folder, outcome.result, outcome.timings, page_material(workbench, plan, outcome),
                        outcome.estimates);
  run_folder.finish();
  return outcome;
}

}  // namespace glovebench::eval
