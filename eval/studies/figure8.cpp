#include <algorithm>
#include <array>
#include <cmath>

#include "eval/studies/cascade_survival.h"
#include "reports/paper_numbers.h"

namespace glovebench::eval {
namespace {

using reports::Cell;
using reports::Measure;
using reports::PaperCascade;
using reports::percentile;
using reports::Table;
using reports::TruthKind;

constexpr const char *kLarge = "DB_20_postures", *kSmall = "DB_open_pinch_power";
const std::vector<std::string> kDatabases = {kLarge, kSmall};

/// The paper's cascades.
std::vector<Cascade> paper_cascades() {
  std::vector<Cascade> cascades;
  for (const PaperCascade& row : reports::paper_numbers().figure_8)
    if (std::ranges::find(cascades, row.cascade) == cascades.end()) cascades.push_back(row.cascade);
  return cascades;
}

const PaperCascade* paper_row(const std::string& database, const Cascade& cascade) {
  const auto& rows = reports::paper_numbers().figure_8;
  const auto it = std::ranges::find_if(
      rows, [&](const PaperCascade& row) { return row.database == database && row.cascade == cascade; });
  return it == rows.end() ? nullptr : &*it;
}

Table empty_cascade_errors_table() {
  return {
      "figure8",
      "Matching cascades",
      "Errors are means over the frames of the five movements (a quick run: a stretch of Tr4) that the tracker "
      "answers, with 95% intervals over blocks of frames. They were measured with the configured implementation: "
      "both give the same matches and points. Posture error is the RMS over the 22 angles, filtered as always; "
      "the paper does not say over which movements its posture errors are. " +
          times_explanation() +
          " They are of the movements themselves, also beside errors on recorded truths; of so few frames the "
          "99th percentile is about the longest. A frame's true nearest neighbor is the database entry with the "
          "smallest mean vertex distance to the true hand, both centered at the hand and seen along the ray to "
          "it; a cascade that keeps 15 entries keeps it more easily than one that keeps 3.",
      {{"database", "database"},
       {"cascade", "cascade"},
       {"implementation", "implementation"},
       {"truth", "truth"},
       {"frames", "frames", 0},
       {"posture_error_deg", "posture deg"},
       {"posture_error_deg_low", "low"},
       {"posture_error_deg_high", "high"},
       {"position_error_mm", "position mm"},
       {"rotation_error_deg", "rotation deg"},
       {"covered_percent", "covered %", 1},
       {"true_neighbor_survives_percent", "true neighbor kept %", 1},
       {"timed_frames", "timed frames", 0},
       {"look_up_ms_p50", "look-up ms p50", 2, true},
       {"look_up_ms_p95", "p95", 2, true},
       {"look_up_ms_p99", "p99", 2, true},
       {"frame_ms_p50", "frame ms p50", 2, true},
       {"frame_ms_p95", "p95", 2, true},
       {"frame_ms_p99", "p99", 2, true},
       {"paper_posture_error_deg", "paper's posture deg"},
       {"paper_time_ms", "paper's ms", 1}},
      4,
      {}};
}

Table empty_stages_table() {
  return {
      "figure8_stages",
      "Stages of the cascades",
      "How many entries each stage is given and keeps, and in how many frames the true nearest neighbor is among "
      "those it keeps.",
      {{"database", "database"},
       {"cascade", "cascade"},
       {"truth", "truth"},
       {"stage", "stage", 0},
       {"size_px", "size px", 0},
       {"candidates_in", "in", 0},
       {"candidates_out", "out", 0},
       {"true_neighbor_survives_percent", "true neighbor kept %", 1}},
      4,
      {}};
}

constexpr std::array kImplementations = {Implementation::plain, Implementation::fast};
/// Timed runs per implementation. Times do not depend on the truth.
using Timed = std::array<Runs, kImplementations.size()>;

/// Selects the stages of one cascade in one database.
std::vector<StageSurvival> stages_of(const std::vector<StageSurvival>& all, const std::string& database,
                                     const Cascade& cascade) {
  std::vector<StageSurvival> stages;
  std::ranges::copy_if(all, std::back_inserter(stages), [&](const StageSurvival& stage) {
    return stage.database == database && stage.cascade == cascade;
  });
  return stages;
}

std::vector<Cell> errors_row(const std::string& database, const Cascade& cascade, Implementation implementation,
                             TruthKind truth, const Selection& runs, const std::vector<StageSurvival>& survival,
                             const Selection& timed) {
  const Sample posture = sample_of(runs, "posture_rms_deg");
  std::vector<Cell> row = {database, to_string(cascade), std::string(to_string(implementation)),
                           std::string(to_string(truth)), static_cast<int64_t>(times_ms(runs).size())};
  append(row, cells(estimate_mean(posture)));
  row.push_back(cell(mean(sample_of(runs, "position_error_mm"))));
  row.push_back(cell(mean(sample_of(runs, "rotation_error_deg"))));
  row.push_back(cell(covered_percent(runs)));
  row.push_back(cell(mean(survival.back().survived_percent)));
  row.push_back(static_cast<int64_t>(times_ms(timed).size()));
  for (const std::vector<double>& times : {times_ms(timed, "look_up"), times_ms(timed)})
    for (const double share : {0.5, 0.95, 0.99}) row.push_back(cell(percentile(times, share)));
  const PaperCascade* paper = paper_row(database, cascade);
  row.push_back(paper ? Cell(paper->posture_error_deg) : Cell());
  row.push_back(paper ? Cell(paper->time_ms) : Cell());
  return row;
}

void add_rows(reports::StudyResult& result, TruthKind truth, const std::vector<Cascade>& cascades, const Runs& runs,
              const std::vector<StageSurvival>& survival, const Timed& timed) {
  for (const std::string& database : kDatabases) {
    for (const Cascade& cascade : cascades) {
      const std::string setting = to_string(cascade);
      const Selection selected = select(runs, setting, database);
      const std::vector<StageSurvival> stages = stages_of(survival, database, cascade);
      for (size_t i = 0; i < kImplementations.size(); ++i)
        result.tables[0].rows.push_back(errors_row(database, cascade, kImplementations[i], truth, selected, stages,
                                                   select(timed[i], setting, database)));
      for (const StageSurvival& stage : stages)
        result.tables[1].rows.push_back({database, setting, std::string(to_string(truth)),
                                         static_cast<int64_t>(stage.stage + 1), int64_t{cascade[stage.stage].size},
                                         int64_t{stage.candidates_in}, int64_t{stage.candidates_out},
                                         cell(mean(stage.survived_percent))});
    }
  }
}

/// The paper's four cascades by their role in its argument.
constexpr const char *kThreeStages = "16:1000,32:300,64:3", *kTwoStages = "16:500,64:3", *kLargestAlone = "64:3",
                     *kSmallestAlone = "8:15";
bool has_all_of_the_paper(const std::vector<Cascade>& cascades) {
  return std::ranges::all_of(
      std::array{kThreeStages, kTwoStages, kLargestAlone, kSmallestAlone},
      [&](const char* text) { return std::ranges::count(cascades, parse_cascade(text)) > 0; });
}

std::vector<Measure> cascade_error_measures(const Runs& runs) {
  std::vector<Sample> posture;
  for (const char* cascade : {kSmallestAlone, kLargestAlone, kTwoStages, kThreeStages})
    posture.push_back(sample_of(select(runs, cascade, kLarge), "posture_rms_deg"));
  const Estimated excess = estimate(posture, [](std::span<const double> means) {
    return std::optional(means[0] - *std::ranges::max_element(means.subspan(1)));
  });
  const Estimated change = estimate(std::vector{posture[2], posture[1]}, [](std::span<const double> means) {
    return std::optional(std::abs(means[0] - means[1]));
  });
  return {{"figure8.posture_change_deg", "deg", change.value, change.interval},
          {"figure8.tiny_posture_excess_deg", "deg", excess.value, excess.interval}};
}

/// Median time of the slowest stage except the alignment.
std::optional<double> slowest_other(const Selection& runs) {
  std::optional<double> slowest;
  for (const char* stage : {"register", "segment", "cloud", "tiny_images", "look_up", "smooth"})
    if (const auto time = percentile(times_ms(runs, stage), 0.5)) slowest = std::max(*time, slowest.value_or(0));
  return slowest;
}

std::vector<Measure> time_measures(const Timed& timed) {
  const auto& [plain, fast] = timed;
  const auto look_up = [&plain = plain](const char* cascade) {
    return percentile(times_ms(select(plain, cascade, kLarge), "look_up"), 0.5);
  };
  const Selection small = select(plain, kTwoStages, kSmall);
  const auto tiny = look_up(kSmallestAlone), large = look_up(kLargestAlone), two = look_up(kTwoStages),
             three = look_up(kThreeStages), other = slowest_other(small),
             align = percentile(times_ms(small, "align"), 0.5),
             frame = percentile(times_ms(select(fast, kTwoStages, kLarge)), 0.95),
             plain_frame = percentile(times_ms(select(plain, kTwoStages, kLarge)), 0.95);
  if (!tiny || !large || !two || !three || !other || !align || !frame || !plain_frame) return {};
  return {{"figure8.time_share", "", *two / *large, {}, true},
          {"figure8.tiny_time_share", "", *tiny / std::min({*large, *two, *three}), {}, true},
          {"figure8.alignment_over_slowest_other_small", "", *align / *other, {}, true},
          {"frame.p95_ms_20_postures", "ms", *frame, {}, true},
          {"frame.p95_ms_20_postures_plain", "ms", *plain_frame, {}, true}};
}

std::vector<Setting> cascade_settings(const TrackerConfig& tracker, const std::vector<Cascade>& cascades) {
  std::vector<Setting> settings;
  for (const Cascade& cascade : cascades) {
    settings.push_back({to_string(cascade), tracker});
    settings.back().tracker.lookup.cascade = cascade;
  }
  return settings;
}

}  // namespace

reports::StudyResult run_figure8(const StudyContext& context) {
  const std::vector<Cascade> cascades =
      context.options.cascades.empty() ? paper_cascades() : context.options.cascades;
  const std::vector<Setting> settings = cascade_settings(context.options.tracker, cascades);
  reports::StudyResult result{
      "fig8", "Figure 8: matching cascades", {empty_cascade_errors_table(), empty_stages_table()}, {}};

  Timed timed;
  for (size_t i = 0; i < kImplementations.size(); ++i)
    timed[i] = time_settings(context, settings, kDatabases, kImplementations[i]);
  const bool judged = has_all_of_the_paper(cascades);
  for (const TruthKind truth : {TruthKind::recorded, TruthKind::source}) {
    const Runs runs = run_study_settings(context, settings, kDatabases, truth);
    add_rows(result, truth, cascades, runs, measure_survival(context, kDatabases, cascades, truth), timed);
    if (judged && truth == TruthKind::source) result.measures = cascade_error_measures(runs);
  }
  if (judged) append(result.measures, time_measures(timed));
  return result;
}

}  // namespace glovebench::eval
