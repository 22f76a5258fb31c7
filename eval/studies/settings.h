#pragma once

#include <functional>
#include <string>
#include <vector>

#include "eval/measured_run.h"
#include "eval/studies/sample.h"
#include "eval/studies/study.h"

namespace glovebench::eval {

/// One way to run the trajectories of a study.
struct Setting {
  std::string name;
  TrackerConfig tracker;
  int subject = 1;
  render::Lighting lighting = {};
  bool clutter_in_volume = false;
};

/// What one setting came to with one database: a stratum a trajectory, in it a run a noise seed.
struct Passes {
  std::vector<std::vector<MeasuredRun>> strata;
};

/// What is run in every setting.
struct Movements {
  std::vector<std::shared_ptr<const trajectories::Trajectory>> truths;
  FrameRange range;
};
/// All frames, or in a quick reproduction the stretch that it looks at.
FrameRange frames_of(const StudyOptions& options);
/// The trajectories of these names, or of all five if there are none; a stretch of one in a quick reproduction.
Movements movements(const StudyContext& context, reports::TruthKind truth,
                    const std::vector<std::string>& names = {});

/// Every setting with every database over the same device frames, gradient noise x 1: [setting][database]. For
/// errors: the runs share the machine, so that their times say little.
std::vector<std::vector<Passes>> run_settings(const StudyContext& context, const Movements& movements,
                                              const std::vector<Setting>& settings,
                                              const std::vector<std::string>& databases);

/// The same for times: with that look-up and closest-point search, on one thread, one tracker at a time, so that
/// none finds its caches emptied by another, over a stretch of each movement (the plain search takes up to a second
/// a frame). The runs are not kept for a program that goes on after an interrupt; the times of a study that was
/// finished are, for this machine.
std::vector<std::vector<Passes>> time_settings(const StudyContext& context, const Movements& movements,
                                               const std::vector<Setting>& settings,
                                               const std::vector<std::string>& databases,
                                               Implementation implementation);
/// What a table says of times that were measured so.
std::string times_explanation();

/// A value of each frame.
Sample sample_of(
    const Passes& passes,
    const std::function<std::optional<double>(const TrackResult&, const reports::FrameErrors&)>& value);
/// A metric of each frame, by its key.
Sample sample_of(const Passes& passes, std::string_view metric);

/// Jitter and latency, of each stratum and noise seed in turn.
std::vector<std::vector<reports::SequenceMetrics>> sequences_of(const Passes& passes);

/// Milliseconds of a stage, or of whole frames if the stage is empty, over all frames of all passes.
std::vector<double> times_ms(const Passes& passes, std::string_view stage = "");
/// The share of frames that are covered, percent.
std::optional<double> covered_percent(const Passes& passes);

/// A value, and the ends of its interval: three cells.
std::vector<reports::Cell> cells(const Estimated& estimated);
using reports::cell;

}  // namespace glovebench::eval
