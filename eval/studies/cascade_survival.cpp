#include "eval/studies/cascade_survival.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>

#include "core/base/error.h"
#include "core/tracker/sighting.h"
#include "eval/terminal.h"
#include "eval/true_neighbor.h"

namespace glovebench::eval {
namespace {

/// A database to look up in, with what finds its true neighbors.
struct Searched {
  std::shared_ptr<const Database> database;
  std::unique_ptr<const TrueNeighborSearch> true_neighbors;
};

/// [database][cascade][stage]
using Survival = std::vector<std::vector<std::vector<StageSurvival>>>;

/// One frame: percent of every stage of every cascade in every database.
using FrameSurvival = std::vector<std::optional<double>>;

std::vector<Searched> load(Workbench& workbench, const std::vector<std::string>& names) {
  std::vector<Searched> searched;
  for (const std::string& name : names) {
    const std::shared_ptr<const Database> database = workbench.database(name);
    searched.push_back({database, std::make_unique<TrueNeighborSearch>(*workbench.model(), *database)});
  }
  return searched;
}

/// The stages of all cascades, without frames yet: `shape` has their strata and seeds.
Survival make_stages(const std::vector<Searched>& searched, const std::vector<Cascade>& cascades,
                     const Sample& shape) {
  Survival survival(searched.size());
  for (size_t d = 0; d < searched.size(); ++d) {
    for (const Cascade& cascade : cascades) {
      std::vector<StageSurvival>& stages = survival[d].emplace_back();
      int in = searched[d].database->entry_count();
      for (const CascadeStage& stage : cascade) {
        stages.push_back({in, std::min(in, stage.keep), shape});
        in = stages.back().candidates_out;
      }
    }
  }
  return survival;
}

FrameSurvival survive(const std::vector<Searched>& searched, const std::vector<Cascade>& cascades,
                      const Sighting& seen, const trajectories::TrajectoryFrame& truth,
                      const PinholeCamera& camera) {
  FrameSurvival survival;
  const bool looked_up = seen.status == TrackStatus::tracked;
  const Square square = looked_up ? bounding_square(seen.cloud.labels) : Square{};
  for (const Searched& in : searched) {
    const int neighbor = in.true_neighbors->nearest(truth.posture, truth.T_camera_hand, camera).entry;
    for (const Cascade& cascade : cascades) {
      LookUpTrace trace;
      if (looked_up)
        look_up(*in.database, make_tiny_images(seen.cloud.labels, square, cascade), cascade, Implementation::fast,
                &trace);
      for (size_t stage = 0; stage < cascade.size(); ++stage) {
        const bool ran = stage < trace.kept.size();
        const bool kept = ran && std::ranges::find(trace.kept[stage], neighbor) != trace.kept[stage].end();
        survival.push_back(kept ? 100.0 : 0.0);
      }
    }
  }
  return survival;
}

/// All frames of a replay.
std::vector<FrameSurvival> replay_look_ups(Workbench& workbench, const Replay& replay,
                                           const std::vector<Searched>& searched,
                                           const std::vector<Cascade>& cascades,
                                           const std::function<void()>& frame_done) {
  const std::shared_ptr<const ColorTable> table = workbench.color_table(replay.tracker.segmentation.color_space);
  const RgbdCalibration& calibration = workbench.calibration();
  render::SyntheticKinect kinect = make_kinect(workbench, replay);
  std::vector<FrameSurvival> frames;
  for (const trajectories::TrajectoryFrame& truth : frames_of(replay)) {
    const std::optional<DeviceFrame> frame = kinect.next_frame();
    check(frame.has_value(), "the device plays every frame of the trajectory");
    frames.push_back(
        survive(searched, cascades, see(*frame, calibration, *table, replay.tracker), truth, calibration.ir));
    frame_done();
  }
  return frames;
}

}  // namespace

Survival measure_survival(const StudyContext& context, const Movements& movements,
                          const std::vector<std::string>& databases, const std::vector<Cascade>& cascades) {
  Workbench& workbench = context.workbench;
  const std::vector<uint64_t>& seeds = context.options.seeds;
  std::vector<Replay> replays;
  Replay replay;
  replay.databases = databases;
  replay.range = movements.range;
  replay.tracker = context.options.tracker;
  for (const auto& truth : movements.truths) {
    for (const uint64_t seed : seeds) {
      replay.truth = truth;
      replay.seed = seed;
      replays.push_back(replay);
    }
  }
  prepare(workbench, replays);
  const std::vector<Searched> searched = load(workbench, databases);

  size_t frames = 0;
  for (const Replay& each : replays) frames += frames_of(each).size();
  Progress progress("following true neighbors", workbench.config().quiet);
  std::atomic<size_t> done{0};
  const auto frame_done = [&] { progress.show(static_cast<double>(++done) / static_cast<double>(frames)); };
  std::vector<std::vector<FrameSurvival>> of_replays(replays.size());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, workbench.config().threads);
  tbb::task_arena arena(workbench.config().threads);
  arena.execute([&] {
    tbb::parallel_for(size_t{0}, replays.size(), [&](size_t r) {
      of_replays[r] = replay_look_ups(workbench, replays[r], searched, cascades, frame_done);
    });
  });

  const Sample shape(movements.truths.size(), std::vector<std::vector<std::optional<double>>>(seeds.size()));
  Survival survival = make_stages(searched, cascades, shape);
  for (size_t r = 0; r < replays.size(); ++r) {
    for (const FrameSurvival& frame : of_replays[r]) {
      size_t next = 0;
      for (auto& of_database : survival)
        for (auto& stages : of_database)
          for (StageSurvival& stage : stages)
            stage.survived_percent[r / seeds.size()][r % seeds.size()].push_back(frame[next++]);
    }
  }
  return survival;
}

}  // namespace glovebench::eval
