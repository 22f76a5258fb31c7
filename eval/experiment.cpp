#include "eval/experiment.h"

#include <sys/resource.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "eval/family_table.h"
#include "eval/measured_run.h"
#include "eval/pictures.h"
#include "eval/program.h"
#include "eval/run_warnings.h"
#include "eval/streaming.h"
#include "eval/terminal.h"
#include "reports/report.h"

namespace glovebench::eval {
namespace {

using reports::ExperimentKey;

/// Measures each seed's sequence and averages over the seeds.
reports::SequenceMetrics measure_sequences(const Experiment& experiment) {
  std::vector<reports::SequenceMetrics> seeds;
  for (const MeasuredRun* each : experiment.runs)
    seeds.push_back(measure_sequence(each->run.answers, frames_of(each->run.spec)));
  return {reports::mean_present(seeds, &reports::SequenceMetrics::jitter_position_mm),
          reports::mean_present(seeds, &reports::SequenceMetrics::jitter_rotation_deg),
          reports::mean_present(seeds, &reports::SequenceMetrics::latency_frames)};
}

/// Of joints that no tracked frame has, nothing is known; they do not count.
reports::PckCurve pck_of(const Experiment& experiment, std::span<const int> joints) {
  std::vector<double> errors_mm;
  std::set<int> given;
  size_t frames = 0, tracked = 0;
  for (const MeasuredRun* each : experiment.runs) {
    for (const reports::FrameErrors& errors : each->errors) {
      ++frames;
      if (errors.joint_errors_mm.empty()) continue;
      ++tracked;
      for (const int joint : joints) {
        const std::optional<double>& error = errors.joint_errors_mm[joint];
        if (!error) continue;
        errors_mm.push_back(*error);
        given.insert(joint);
      }
    }
  }
  return reports::pck_curve(errors_mm, frames * (tracked > 0 ? given.size() : joints.size()));
}

reports::ExperimentTiming timing_of(const Experiment& experiment) {
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

reports::ExperimentEstimates estimates_of(const Experiment& experiment) {
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

reports::Timings timings_of(const std::vector<Experiment>& experiments, int threads) {
  reports::Timings timings = host_timings(threads);
  for (const Experiment& experiment : experiments) timings.experiments.push_back(timing_of(experiment));
  return timings;
}

/// Adds the wall time since `start` and the peak memory.
void note_resources(reports::Timings& timings, std::chrono::steady_clock::time_point start) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  timings.peak_memory_mb = static_cast<double>(usage.ru_maxrss) / 1024;
  timings.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

reports::ExperimentResult evaluate(const Experiment& experiment) {
  std::vector<reports::SeedRun> runs;
  for (const MeasuredRun* each : experiment.runs) {
    reports::SeedRun& run = runs.emplace_back(reports::SeedRun{each->run.spec.seed, {}});
    for (const reports::FrameErrors& errors : each->errors) run.frames.push_back(errors.record);
  }
  std::array<int, kForearmJoint> joints;
  std::iota(joints.begin(), joints.end(), 0);
  reports::ExperimentResult result = reports::summarize(experiment.key, std::move(runs), pck_of(experiment, joints),
                                                        measure_sequences(experiment));
  result.fingertip_pck = pck_of(experiment, fingertip_joints());
  return result;
}

bool has_hands(const Experiment& experiment) {
  return std::ranges::all_of(experiment.runs, [](const MeasuredRun* each) {
    return std::ranges::all_of(each->run.answers, [](const TrackResult& answer) { return answer.has.hand(); });
  });
}

std::vector<Experiment> experiments_of(std::span<const MeasuredRun> runs) {
  std::vector<Experiment> experiments;
  for (const MeasuredRun& each : runs) {
    const ExperimentKey key = key_of(each.run.spec);
    auto it = std::ranges::find(experiments, key, &Experiment::key);
    if (it == experiments.end()) it = experiments.insert(it, {key, {}});
    for (const MeasuredRun* other : it->runs)
      check(other->run.spec.seed != each.run.spec.seed, "a seed counts once");
    it->runs.push_back(&each);
  }
  return experiments;
}

reports::RunResult results_of(const Plan& plan, std::span<const MeasuredRun> runs, Workbench& workbench) {
  reports::RunResult result;
  result.protocol = reports::make_protocol(plan.association);
  for (const RunSpec& spec : plan.specs) {
    result.inputs.truths[truth_name(key_of(spec))] = trajectories::hash(*spec.trajectory);
    // Other programs' estimates are what is compared, so their hash may differ.
    result.inputs.databases[spec.database] =
        plan.score.is_null() ? workbench.database(spec.database)->content_hash() : "estimates";
  }
  result.inputs.hand_model = workbench.model()->hash();
  if (plan.score.is_null()) {
    const auto color_table = workbench.color_table(plan.tracker.segmentation.color_space);
    result.inputs.color_table = hash_bytes(std::as_bytes(std::span(color_table->labels())));
  }
  result.suite = plan.suite;
  result.program_version = program_info().version;
  result.commit = program_info().commit;
  if (plan.score.is_null())
    result.configuration = {{"tracker", to_json(plan.tracker)}};
  else
    result.configuration = {{"score", plan.score}};
  if (plan.quick) result.configuration["quick"] = true;
  if (const auto& streaming = plan.streaming)
    result.configuration["streaming"] = streaming->tracker_ms ? nlohmann::json(*streaming->tracker_ms) : "measured";
  if (const auto cameras = to_json(workbench.calibration()); cameras != to_json(synthetic_calibration()))
    result.configuration["calibration"] = cameras;
  if (const auto& hand = workbench.config().hand) result.configuration["hand"] = to_json(*hand);
  for (const Experiment& experiment : experiments_of(runs)) result.experiments.push_back(evaluate(experiment));
  return result;
}

Outcome carry_out(Workbench& workbench, const Plan& plan, const RobotOutput& robot, const std::string& folder,
                  const AddStudies& add_studies) {
  const auto start = std::chrono::steady_clock::now();
  const int threads = workbench.config().threads;
  RunStore store(folder);
  const RunOptions options = plan.times_frames() ? RunOptions{} : RunOptions{threads, &store};
  const std::vector<MeasuredRun> runs = measure(workbench, execute(workbench, plan.specs, options));
  const Outcome outcome = report_runs(workbench, plan, runs, {threads, start}, robot, folder,
                                      [&](reports::RunResult& result) { add_studies(result, store); });
  store.finish();
  return outcome;
}

Outcome report_runs(Workbench& workbench, const Plan& plan, std::span<const MeasuredRun> runs,
                    const TimedWith& timed, const RobotOutput& robot, const std::string& folder,
                    const std::function<void(reports::RunResult&)>& add_studies) {
  const std::vector<Experiment> experiments = experiments_of(runs);
  Outcome outcome{results_of(plan, runs, workbench), timings_of(experiments, timed.threads)};
  add_commands(outcome.result, outcome.timings, runs, robot);
  if (!timed.commands)
    for (reports::ExperimentTiming& experiment : outcome.timings.experiments) experiment.command_ms.clear();
  if (auto families = family_table(runs)) outcome.result.studies.push_back(*std::move(families));
  if (plan.streaming) outcome.result.studies.push_back(streaming_study(workbench, *plan.streaming, runs));
  add_studies(outcome.result);
  note_resources(outcome.timings, timed.start);
  std::vector<reports::ExperimentEstimates> estimates;
  for (const Experiment& experiment : experiments)
    if (has_hands(experiment)) estimates.push_back(estimates_of(experiment));
  reports::PageMaterial material = page_material(workbench, plan, outcome.result, estimates);
  for (const std::string& warning : no_answer_warnings(no_answer_reasons(runs))) {
    say("glovebench: warning: {}\n", warning);
    material.warnings.push_back(warning);
  }
  reports::write_report(folder, outcome.result, outcome.timings, material, estimates);
  return outcome;
}

}  // namespace glovebench::eval
