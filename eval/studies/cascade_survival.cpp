#include "eval/studies/cascade_survival.h"

#include <algorithm>
#include <atomic>

#include "core/base/error.h"
#include "core/tracker/sighting.h"
#include "eval/terminal.h"
#include "eval/threads.h"
#include "eval/true_neighbor.h"

namespace glovebench::eval {
namespace {

/// A database and the search for its true neighbors.
struct Searched {
  std::shared_ptr<const Database> database;
  std::unique_ptr<const TrueNeighborSearch> true_neighbors;
};

/// Of one frame, in percent, in the order of the stages.
using FrameSurvival = std::vector<std::optional<double>>;

std::vector<Searched> load(Workbench& workbench, const std::vector<std::string>& names) {
  std::vector<Searched> searched;
  for (const std::string& name : names) {
    const std::shared_ptr<const Database> database = workbench.database(name);
    searched.push_back({database, std::make_unique<TrueNeighborSearch>(*workbench.model(), *database)});
  }
  return searched;
}

/// All stages of all cascades and databases, without frames.
std::vector<StageSurvival> all_stages(const std::vector<std::string>& names, const std::vector<Searched>& searched,
                                      const std::vector<Cascade>& cascades) {
  std::vector<StageSurvival> stages;
  for (size_t d = 0; d < searched.size(); ++d) {
    for (const Cascade& cascade : cascades) {
      int in = searched[d].database->entry_count();
      for (size_t s = 0; s < cascade.size(); ++s) {
        stages.push_back({names[d], cascade, s, in, std::min(in, cascade[s].keep), {}});
        in = stages.back().candidates_out;
      }
    }
  }
  return stages;
}

FrameSurvival survive(const std::vector<Searched>& searched, const std::vector<Cascade>& cascades,
                      const Sighting& seen, const HandFrame& truth, const PinholeCamera& camera) {
  FrameSurvival survival;
  const bool looked_up = seen.status == TrackStatus::tracked;
  const Square square = looked_up ? bounding_square(seen.cloud.labels) : Square{};
  for (const Searched& in : searched) {
    const int neighbor = in.true_neighbors->nearest(truth.posture, truth.T_camera_hand, camera).entry;
    for (const Cascade& cascade : cascades) {
      LookUpTrace trace;
      if (looked_up)
        look_up(*in.database, make_tiny_images(seen.cloud.labels, square, cascade), cascade, "fast", &trace);
      for (size_t stage = 0; stage < cascade.size(); ++stage) {
        const bool ran = stage < trace.kept.size();
        const bool kept = ran && std::ranges::find(trace.kept[stage], neighbor) != trace.kept[stage].end();
        survival.push_back(kept ? 100.0 : 0.0);
      }
    }
  }
  return survival;
}

/// All frames of a run in all databases.
std::vector<FrameSurvival> run_look_ups(Workbench& workbench, const RunSpec& spec,
                                        const std::vector<Searched>& searched, const std::vector<Cascade>& cascades,
                                        const std::function<void()>& frame_done) {
  const std::shared_ptr<const ColorTable> table = workbench.color_table(spec.tracker.segmentation.color_space);
  const RgbdCalibration& calibration = workbench.calibration();
  render::SyntheticKinect kinect = make_kinect(workbench, spec);
  std::vector<FrameSurvival> frames;
  for (const HandFrame& truth : frames_of(spec)) {
    const std::optional<DeviceFrame> frame = kinect.next_frame();
    check(frame.has_value(), "the device plays every frame of the trajectory");
    frames.push_back(
        survive(searched, cascades, see(*frame, calibration, *table, spec.tracker), truth, calibration.ir));
    frame_done();
  }
  return frames;
}

}  // namespace

std::vector<StageSurvival> measure_survival(const StudyContext& context, const std::vector<std::string>& databases,
                                            const std::vector<Cascade>& cascades, reports::TruthKind truth) {
  Workbench& workbench = context.workbench;
  const TrackerConfig& tracker = context.options.tracker;
  // One spec per frame sequence; it is looked up in all databases.
  const std::vector<RunSpec> specs =
      study_specs(context, {{.name = "look-up", .tracker = tracker}}, {databases.front()}, truth);
  // Before the threads start, since making these uses all threads.
  const std::vector<Searched> searched = load(workbench, databases);
  workbench.color_table(tracker.segmentation.color_space);

  size_t frames = 0;
  for (const RunSpec& each : specs) frames += frames_of(each).size();
  Progress progress("following true neighbors", workbench.config().quiet);
  std::atomic<size_t> done{0};
  const auto frame_done = [&] { progress.show(static_cast<double>(++done) / static_cast<double>(frames)); };
  std::vector<std::vector<FrameSurvival>> of_runs(specs.size());
  in_parallel(workbench.config().threads, specs.size(),
              [&](size_t r) { of_runs[r] = run_look_ups(workbench, specs[r], searched, cascades, frame_done); });

  std::vector<StageSurvival> stages = all_stages(databases, searched, cascades);
  for (size_t s = 0; s < stages.size(); ++s) {
    Sample& sample = stages[s].survived_percent;
    for (size_t r = 0; r < specs.size(); ++r) {
      if (r == 0 || specs[r].trajectory != specs[r - 1].trajectory) sample.emplace_back();
      std::vector<std::optional<double>>& values = sample.back().emplace_back();
      for (const FrameSurvival& frame : of_runs[r]) values.push_back(frame[s]);
    }
  }
  return stages;
}

}  // namespace glovebench::eval
