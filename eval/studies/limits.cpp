#include "core/base/error.h"
#include "core/tracker/tracker_config.h"
#include "eval/family_table.h"
#include "eval/studies/study.h"
#include "eval/suite.h"
#include "eval/threads.h"

namespace glovebench::eval {
namespace {

using reports::StudyResult;
using reports::Table;

/// The runs of the suite `families`; quick: a stretch of one movement.
std::vector<RunSpec> family_specs(const StudyContext& context) {
  Suite suite = load_suite("families");
  suite.seeds = context.options.seeds;
  std::vector<RunSpec> specs = plan_suite(context.workbench, profile("recommended"), suite, "").specs;
  if (context.options.quick) specs.resize(1);
  for (RunSpec& spec : specs) spec.frames = frames_of(context.options);
  return specs;
}

TrackResult true_result(const HandFrame& truth) {
  TrackResult result;
  result.status = TrackStatus::tracked;
  result.timestamp_us = truth.timestamp_us;
  result.posture = result.posture_unfiltered = truth.posture;
  result.T_camera_hand = result.T_camera_hand_unfiltered = truth.T_camera_hand;
  return result;
}

/// Tracks each frame as if the tracker had found the truth in the frame before.
Run track_after_truth(Workbench& workbench, const Run& usual) {
  Run run = usual;
  render::SyntheticKinect kinect = make_kinect(workbench, run.spec);
  const std::unique_ptr<Method> method = workbench.make_method(run.spec.tracker, run.spec.database);
  const std::span<const HandFrame> truths = frames_of(run.spec);
  for (size_t f = 0; f < truths.size(); ++f) {
    const std::optional<DeviceFrame> frame = kinect.next_frame();
    check(frame.has_value(), "the device plays every frame of the trajectory");
    std::vector<TrackResult> previous;
    if (f > 0) previous.push_back(true_result(truths[f - 1]));
    run.answers[f] = method->track(*frame, previous);
  }
  return run;
}

/// Changes each tracked answer, knowing its truth.
template <typename Change>
Run changed(Run run, const Change& change) {
  const std::span<const HandFrame> truths = frames_of(run.spec);
  for (size_t f = 0; f < truths.size(); ++f)
    if (run.answers[f].status == TrackStatus::tracked) change(run.answers[f], truths[f]);
  return run;
}
bool is_hidden(const TrackResult& result, int angle) {
  return result.certainty && result.certainty->hidden >> angle & 1;
}

Run with_hidden_angles_true(const Run& usual) {
  return changed(usual, [](TrackResult& answer, const HandFrame& truth) {
    for (int a = 0; a < kAngleCount; ++a)
      if (is_hidden(answer, a)) answer.posture[a] = truth.posture[a];
  });
}

/// Pose and seen angles are true, hidden ones are as they were last seen. Before that they are estimated.
Run with_hidden_angles_held(const Run& usual) {
  std::array<std::optional<double>, kAngleCount> last_seen;
  return changed(usual, [&](TrackResult& answer, const HandFrame& truth) {
    for (int a = 0; a < kAngleCount; ++a) {
      if (!is_hidden(answer, a)) last_seen[a] = truth.posture[a];
      answer.posture[a] = last_seen[a].value_or(answer.posture[a]);
    }
    answer.T_camera_hand = truth.T_camera_hand;
  });
}

constexpr const char* kExplanation =
    "Suite families. As it is: people whose hands were not measured, in a glove of other dyes than the "
    "tracker's. Then the tracker is given truths: hand and glove (its own mesh performs the movements); besides, "
    "either pose and posture of the frame before, or the angles that it calls hidden. All but hidden: pose and "
    "seen angles are true, hidden ones are as they were last seen. That is no bound, since an estimate can be "
    "nearer. Lost frames stay lost.";

struct Variant {
  std::string key, heading;
  Table families;
};

/// One column of each variant's families.
Table table_of(const std::string& name, std::string_view metric, const std::string& title,
               const std::string& explanation, const std::vector<Variant>& variants) {
  Table table = {name, title, explanation, {{"family", "family"}}, 1, {}};
  for (const reports::Row& row : variants.front().families.rows) table.rows.push_back({row.front()});
  for (const Variant& variant : variants) {
    table.columns.push_back({variant.key, variant.heading, 1});
    for (size_t r = 0; r < table.rows.size(); ++r)
      table.rows[r].push_back(variant.families.rows[r].at(column_index(variant.families, metric)));
  }
  return table;
}

}  // namespace

StudyResult run_limits(const StudyContext& context) {
  Workbench& workbench = context.workbench;
  std::vector<RunSpec> specs = family_specs(context);
  const auto run = [&](std::span<const RunSpec> of) {
    return execute(workbench, of, {workbench.config().threads, context.store});
  };
  const auto each = [&](const std::vector<Run>& runs, const auto& change) {
    std::vector<Run> changed_runs(runs.size());
    in_parallel(workbench.config().threads, runs.size(), [&](size_t r) { changed_runs[r] = change(runs[r]); });
    return changed_runs;
  };
  const auto families = [&](const std::vector<Run>& runs) {
    return family_table(measure(workbench, runs))->tables.front();
  };
  const std::vector<Run> people = run(specs);
  for (RunSpec& spec : specs) spec.subject = 1;
  const std::vector<Run> own = run(specs);
  const std::vector<Variant> variants = {
      {"people", "as it is", families(people)},
      {"own_hand", "hand and glove", families(own)},
      {"frame_before", "and frame before",
       families(each(own, [&](const Run& r) { return track_after_truth(workbench, r); }))},
      {"hidden_angles", "or hidden angles", families(each(own, with_hidden_angles_true))},
      {"held", "all but hidden", families(each(own, with_hidden_angles_held))}};
  return {"limits",
          "What limits profile recommended",
          {table_of("limits_usable", "usable_percent", "Usable frames, %", kExplanation, variants),
           table_of("limits_position", "position_error_mm", "Position, mm", "Of tracked frames.", variants),
           table_of("limits_fingertips", "fingertip_error_mm", "Fingertips, mm", "Of tracked frames.", variants),
           table_of("limits_posture", "posture_rms_deg", "Posture, RMS of 22 angles, deg", "Of tracked frames.",
                    variants)},
          {}};
}

}  // namespace glovebench::eval
