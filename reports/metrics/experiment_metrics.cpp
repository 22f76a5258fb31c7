// Numbers of a whole experiment: coverage, PCK, and what only a sequence of frames has.

#include "reports/metrics/metric.h"
#include "reports/results.h"

namespace glovebench::reports {
namespace {

using Experiment = const ExperimentResult&;
using Value = std::optional<double>;

constexpr std::string_view kAllFrames = "all frames, lost ones too",
                           kVisibleFrames = "the visible frames, lost ones too";

Value percent(Value share) {
  if (share) *share *= 100;
  return share;
}

std::vector<Metric> pck_metrics() {
  constexpr std::string_view kFormula = "mean of the share of points within t over t from 0 to 50 mm (trapezoids)";
  return {{.key = "joint_pck_area",
           .description = "PCK of the 25 joints: area under the curve (AUC)",
           .formula = kFormula,
           .heading = "joint AUC",
           .place = 2000,
           .of_experiment = [](Experiment e) { return e.pck.area; },
           .over = "all frames; in lost ones no joint is within t",
           .digits = 3},
          {.key = "fingertip_pck_area",
           .description = "PCK of the five fingertips: area under the curve (AUC)",
           .formula = kFormula,
           .heading = "fingertip AUC",
           .place = 2010,
           .of_experiment = [](Experiment e) { return e.fingertip_pck ? e.fingertip_pck->area : Value(); },
           .over = "all frames; in lost ones no fingertip is within t",
           .digits = 3}};
}

std::vector<Metric> sequence_metrics() {
  constexpr std::string_view kAtRest =
      "10 or more pairs of successive tracked frames, the true hand at rest (under 1 mm, 0.5 degrees); mean over "
      "the seeds";
  return {
      {.key = "jitter_position_mm",
       .unit = "mm",
       .description = "jitter at rest: change of the position error from frame to frame",
       .formula = "root mean square of |(p' - p) - (p' - p of the frame before)|",
       .heading = "jitter mm",
       .place = 2020,
       .of_experiment = [](Experiment e) { return e.sequence.jitter_position_mm; },
       .over = kAtRest},
      {.key = "jitter_rotation_deg",
       .unit = "deg",
       .description = "jitter at rest: change of the rotation error from frame to frame",
       .formula = "root mean square of the angle between R' R^T and that of the frame before",
       .heading = "jitter deg",
       .place = 2030,
       .of_experiment = [](Experiment e) { return e.sequence.jitter_rotation_deg; },
       .over = kAtRest},
      {.key = "latency_frames",
       .unit = "frames",
       .description = "lag of the estimated posture behind the true one; no processing time",
       .formula = "the d from 0 to 10 with the least sum over t of |a'(t) - a(t - d)|, by a parabola",
       .heading = "latency frames",
       .place = 2040,
       .of_experiment = [](Experiment e) { return e.sequence.latency_frames; },
       .over =
           "10 or more tracked frames after the first 10, if the posture moves by 10 degrees; mean over the seeds",
       .digits = 1}};
}

std::vector<Metric> level_metrics() {
  return {{.key = "covered_percent",
           .unit = "%",
           .description = "coverage: tracked within 50 mm and 30 degrees",
           .formula = "100 covered frames / frames",
           .heading = "coverage %",
           .place = 2050,
           .of_experiment = [](Experiment e) { return percent(e.coverage.share()); },
           .over = kAllFrames,
           .digits = 1},
          {.key = "found_percent",
           .unit = "%",
           .description = "found: tracked within 50 mm and 30 degrees",
           .formula = "100 (visible and covered frames) / visible frames",
           .place = 2060,
           .of_experiment = [](Experiment e) { return percent(e.coverage.found_share()); },
           .over = kVisibleFrames,
           .digits = 1},
          {.key = "usable_percent",
           .unit = "%",
           .description = "usable: tracked within 10 mm and 10 degrees, the fingertips within 20 mm on average",
           .formula = "100 usable frames / visible frames",
           .place = 2070,
           .of_experiment = [](Experiment e) { return percent(e.coverage.usable_share()); },
           .over = kVisibleFrames,
           .digits = 1}};
}

Metric count(int place, std::string_view key, std::string_view heading, std::string_view description,
             std::optional<double> (*of)(Experiment)) {
  return {.key = key,
          .unit = "frames",
          .description = description,
          .formula = "count",
          .heading = heading,
          .place = place,
          .of_experiment = of,
          .over = "all frames and seeds",
          .digits = 0};
}

}  // namespace

std::vector<Metric> experiment_metrics() {
  std::vector<Metric> all = {
      count(2080, "lost_frames", "lost", "frames in which no hand is reported",
            [](Experiment e) { return Value(e.coverage.lost); }),
      count(2090, "false_tracked_frames", "false tracked", "tracked frames that are 50 mm or 30 degrees off",
            [](Experiment e) { return Value(e.coverage.false_tracked); }),
      count(2100, "false_lost_frames", "false lost", "lost frames in which the hand could be tracked",
            [](Experiment e) { return Value(e.coverage.false_lost); }),
      count(2110, "frames", "frames", "frames of the movement, once for each noise seed",
            [](Experiment e) { return Value(e.coverage.frames); }),
      count(2120, "visible_frames", "visible frames", "frames in which visible_percent is at least 30",
            [](Experiment e) { return Value(e.coverage.visible); })};
  for (const auto& some : {pck_metrics(), sequence_metrics(), level_metrics()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace glovebench::reports
