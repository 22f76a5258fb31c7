#include "eval/streaming.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/error.h"
#include "eval/experiment.h"
#include "reports/summary.h"
#include "trajectories/trajectory_properties.h"

namespace glovebench::eval {
namespace {

using reports::Column;
using reports::Table;

double milliseconds(const HandFrame& frame) { return static_cast<double>(frame.timestamp_us) / 1000; }

std::vector<double> arrivals_ms(const RunSpec& spec) {
  std::vector<double> arrivals;
  for (const HandFrame& frame : frames_of(spec)) arrivals.push_back(milliseconds(frame));
  return arrivals;
}

/// By frame. A program starts in its first frame, but a live system before: that frame takes as long as the second.
std::vector<double> tracker_times_ms(const Streaming& streaming, const Run& run) {
  if (streaming.tracker_ms) return std::vector<double>(run.answers.size(), *streaming.tracker_ms);
  std::vector<double> times = run.frame_ms;
  if (times.size() > 1) times[0] = times[1];
  return times;
}

std::vector<Playback> playbacks_of(const Streaming& streaming, std::span<const MeasuredRun> runs) {
  std::vector<Playback> playbacks;
  for (const MeasuredRun& each : runs)
    playbacks.push_back(play(arrivals_ms(each.run.spec), tracker_times_ms(streaming, each.run)));
  return playbacks;
}

bool drops(const Playback& playback, const MeasuredRun& run) {
  return playback.kept.size() < run.run.answers.size();
}

/// Tracks what drops frames. A run is empty if it drops none.
std::vector<Run> track_kept(Workbench& workbench, std::span<const MeasuredRun> runs,
                            const std::vector<Playback>& playbacks) {
  std::vector<RunSpec> specs;
  std::vector<size_t> places;
  for (size_t r = 0; r < runs.size(); ++r) {
    if (!drops(playbacks[r], runs[r])) continue;
    RunSpec& spec = specs.emplace_back(runs[r].run.spec);
    spec.dropped.assign(runs[r].run.answers.size(), true);
    for (const size_t frame : playbacks[r].kept) spec.dropped[frame] = false;
    places.push_back(r);
  }
  std::vector<Run> tracked(runs.size());
  std::vector<Run> made = execute(workbench, specs, {workbench.config().threads});
  for (size_t i = 0; i < made.size(); ++i) tracked[places[i]] = std::move(made[i]);
  return tracked;
}

constexpr size_t kUsesPerFrame = 8;

/// The frames and, between each two, moments at equal distances. The last frame is the last moment.
std::vector<HandFrame> moments_of(const RunSpec& spec) {
  const std::span<const HandFrame> frames = frames_of(spec);
  std::vector<HandFrame> moments;
  for (size_t f = 0; f + 1 < frames.size(); ++f)
    for (size_t use = 0; use < kUsesPerFrame; ++use)
      moments.push_back(
          trajectories::frame_between(frames[f], frames[f + 1], static_cast<double>(use) / kUsesPerFrame));
  moments.push_back(frames.back());
  return moments;
}

/// The answers in use at the moments, with the truth there and the sight of the frame before. Before the first
/// answer the hand is lost.
Run run_in_use(const Run& usual, const Run& kept, const Playback& playback) {
  const std::vector<TrackResult>& answers = kept.answers.empty() ? usual.answers : kept.answers;
  TrackResult none;
  none.has = answers.front().has;
  trajectories::Trajectory truth = *usual.spec.trajectory;
  truth.frames = moments_of(usual.spec);
  Run run;
  run.spec = usual.spec;
  run.spec.frames = {};
  for (size_t m = 0; m < truth.frames.size(); ++m) {
    const std::optional<size_t> place = playback.in_use(milliseconds(truth.frames[m]));
    run.answers.push_back(place ? answers[*place] : none);
    run.seen.push_back(usual.seen[m / kUsesPerFrame]);
  }
  run.spec.trajectory = std::make_shared<const trajectories::Trajectory>(std::move(truth));
  return run;
}

std::vector<MeasuredRun> measure_in_use(Workbench& workbench, std::span<const MeasuredRun> runs,
                                        const std::vector<Playback>& playbacks) {
  const std::vector<Run> kept = track_kept(workbench, runs, playbacks);
  std::vector<Run> in_use;
  for (size_t r = 0; r < runs.size(); ++r) in_use.push_back(run_in_use(runs[r].run, kept[r], playbacks[r]));
  return measure(workbench, std::move(in_use));
}

/// Metrics that stand in the table twice: as usual, and of the answers in use.
struct Shown {
  std::string_view metric;
  std::string_view heading;
  int digits;
};
constexpr std::array<Shown, 3> kShown = {
    {{"position_error_mm", "pos. mm", 2}, {"fingertip_error_mm", "tips mm", 2}, {"usable_percent", "usable %", 1}}};

Table empty_table(const Streaming& streaming) {
  const bool is_time = !streaming.tracker_ms;
  std::vector<Column> columns = {{"tracker_ms", "time ms", 1, is_time},
                                 {"dropped_percent", "dropped %", 1, is_time},
                                 {"age_ms", "age ms", 1, is_time}};
  for (const Shown& shown : kShown) {
    columns.push_back({std::string(shown.metric), std::string(shown.heading), shown.digits});
    columns.push_back({fmt::format("streaming_{}", shown.metric), "in use", shown.digits, is_time});
  }
  Table table = reports::experiment_table(columns);
  for (Column& column : table.columns)
    if (column.key.empty()) column.key = column.heading;
  table.name = kStreamingStudy;
  table.title = "Streaming accuracy";
  table.explanation = fmt::format(
      "In use: the errors of the newest answer that is finished, against the truth at {} moments a frame, which "
      "lies between two frames' truths; before the first answer the hand is lost (after Li, Wang and Ramanan 2020, "
      "who use answers when a frame is taken). A tracker that has finished takes the newest frame; frames that it "
      "never takes are dropped, and it does not see them. Age: from the frame of the answer in use to its use. "
      "Time: mean over the answered frames; {}.",
      kUsesPerFrame,
      is_time
          ? "of our trackers the processor time, of a program the time until it answers, while no other job of the "
            "command ran. The first frame takes as long as the second, since a live system has started before, and "
            "does not count. Other times give other results"
          : "as given");
  return table;
}

/// Means of one experiment over its frames and seeds. Empty without an answer.
struct PlaybackMeans {
  std::optional<double> tracker_ms;
  double dropped_percent = 0;
  std::optional<double> age_ms;
};

bool is_answer(const TrackResult& result) { return result.status != TrackStatus::missing; }

PlaybackMeans means_of(const Streaming& streaming, const Experiment& experiment, std::span<const MeasuredRun> runs,
                       const std::vector<Playback>& playbacks, std::span<const MeasuredRun> in_use) {
  std::vector<double> times, ages;
  size_t kept = 0, frames = 0;
  for (const MeasuredRun* each : experiment.runs) {
    const auto r = static_cast<size_t>(each - runs.data());
    const std::vector<double> arrivals = arrivals_ms(each->run.spec);
    const std::vector<double> tracker_ms = tracker_times_ms(streaming, each->run);
    const size_t first = tracker_ms.size() > 1 ? 1 : 0;  // the first frame has the second one's time
    for (size_t f = first; f < tracker_ms.size(); ++f)
      if (is_answer(each->run.answers[f])) times.push_back(tracker_ms[f]);
    kept += playbacks[r].kept.size();
    frames += tracker_ms.size();
    const std::vector<HandFrame> moments = moments_of(each->run.spec);
    for (size_t m = 0; m < moments.size(); ++m) {
      const double moment = milliseconds(moments[m]);
      const std::optional<size_t> place = playbacks[r].in_use(moment);
      if (place && is_answer(in_use[r].run.answers[m]))
        ages.push_back(moment - arrivals[playbacks[r].kept[*place]]);
    }
  }
  const double kept_share = static_cast<double>(kept) / static_cast<double>(frames);
  return {reports::mean(times), 100 * (1 - kept_share), reports::mean(ages)};
}

}  // namespace

std::optional<size_t> Playback::in_use(double moment_ms) const {
  const auto later = std::ranges::upper_bound(finished_ms, moment_ms);
  if (later == finished_ms.begin()) return std::nullopt;
  return static_cast<size_t>(later - finished_ms.begin()) - 1;
}

Playback play(std::span<const double> arrival_ms, std::span<const double> tracker_ms) {
  check(arrival_ms.size() == tracker_ms.size(), "a tracker's time for each frame");
  Playback playback;
  for (size_t frame = 0; frame < arrival_ms.size();) {
    const double free_ms = playback.finished_ms.empty() ? arrival_ms[0] : playback.finished_ms.back();
    const double finished_ms = std::max(free_ms, arrival_ms[frame]) + tracker_ms[frame];
    playback.kept.push_back(frame);
    playback.finished_ms.push_back(finished_ms);
    const auto arrived =
        static_cast<size_t>(std::ranges::upper_bound(arrival_ms, finished_ms) - arrival_ms.begin());
    frame = std::max(frame + 1, arrived - 1);
  }
  return playback;
}

reports::StudyResult streaming_study(Workbench& workbench, const Streaming& streaming,
                                     std::span<const MeasuredRun> runs) {
  const std::vector<Playback> playbacks = playbacks_of(streaming, runs);
  const std::vector<MeasuredRun> in_use = measure_in_use(workbench, runs, playbacks);
  const std::vector<Experiment> usual = experiments_of(runs), streamed = experiments_of(in_use);
  Table table = empty_table(streaming);
  for (size_t e = 0; e < usual.size(); ++e) {
    const PlaybackMeans means = means_of(streaming, usual[e], runs, playbacks, in_use);
    reports::Row& row = table.rows.emplace_back(reports::experiment_names(usual[e].key));
    row.insert(row.end(), {reports::cell(means.tracker_ms), means.dropped_percent, reports::cell(means.age_ms)});
    const reports::ExperimentResult as_usual = evaluate(usual[e]), as_used = evaluate(streamed[e]);
    for (const Shown& shown : kShown) {
      const reports::Metric& metric = reports::metric_of(shown.metric);
      for (const reports::ExperimentResult* result : {&as_usual, &as_used})
        row.push_back(reports::cell(value_of(metric, *result)));
    }
  }
  return {kStreamingStudy, table.title, {std::move(table)}, {}};
}

reports::StudyResult joined_streaming(const std::vector<std::pair<std::string, reports::StudyResult>>& studies) {
  check(!studies.empty(), "there is a setting");
  reports::StudyResult joined = studies.front().second;
  Table& all = joined.tables.front();
  all.columns.insert(all.columns.begin(), {"setting", "setting"});
  ++all.name_columns;
  all.rows.clear();
  for (const auto& [setting, study] : studies) {
    for (reports::Row row : study.tables.front().rows) {
      row.insert(row.begin(), setting);
      all.rows.push_back(std::move(row));
    }
  }
  return joined;
}

}  // namespace glovebench::eval
