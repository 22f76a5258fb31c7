#include <fmt/format.h>

#include <array>
#include <cmath>

#include "eval/studies/study.h"

namespace glovebench::eval {
namespace {

using reports::Measure;
using reports::Table;
using reports::TruthKind;

constexpr std::array<int, 7> kFactors = {1, 2, 4, 8, 16, 32, 64};
/// Databases with movements whose grasp they hold.
struct Sampled {
  std::vector<std::string> databases, trajectories;
};
const std::vector<Sampled> kSampled = {
    {{"DB_open_power", "DB_open_pinch_power", "DB_20_postures"}, {"Tr3", "Tr4", "Tr5"}},
    {{"DB_open_pinch"}, {"Tr1", "Tr2"}}};
/// The grasp-specific database of power grasps, as in Figure 5. The claims are about it.
constexpr const char* kClaimedDatabase = "DB_open_power";

std::vector<Setting> sampling_settings(const TrackerConfig& tracker) {
  std::vector<Setting> settings;
  for (const int factor : kFactors) {
    Setting setting{std::to_string(factor), tracker};
    setting.tracker.icp.subsampling_factor = factor;
    settings.push_back(setting);
  }
  return settings;
}

Table empty_sampling_errors_table() {
  return {"figure9",
          "Sub-sampling of the point cloud",
          "Every n-th point of the cloud goes into the alignment (n = factor). Means over the frames of Tr3, Tr4 "
          "and Tr5 (DB_open_pinch: Tr1 and Tr2; a quick run: a stretch of Tr4) that the tracker answers, with 95% "
          "intervals over blocks of frames. The paper's figure prints no numbers and names no database.",
          {{"truth", "truth"},
           {"database", "database"},
           {"factor", "factor", 0},
           {"icp_points", "points", 0},
           {"position_error_mm", "position mm"},
           {"position_error_mm_low", "low"},
           {"position_error_mm_high", "high"},
           {"rotation_error_deg", "rotation deg"},
           {"rotation_error_deg_low", "low"},
           {"rotation_error_deg_high", "high"},
           {"covered_percent", "covered %", 1}},
          3,
          {}};
}

Table empty_times_table() {
  return {"figure9_times",
          "Time with sub-sampling",
          fmt::format("{} Measured with {} alone.", times_explanation(), kClaimedDatabase),
          {{"implementation", "implementation"},
           {"factor", "factor", 0},
           {"frame_ms_p50", "frame ms", 2, true},
           {"frame_ms_p95", "p95", 2, true},
           {"align_ms_p50", "alignment ms", 2, true},
           {"look_up_ms_p50", "look-up ms", 2, true}},
          2,
          {}};
}

Selection of_factor(const Runs& runs, int factor, const std::string& database = kClaimedDatabase) {
  return select(runs, std::to_string(factor), database);
}

void add_errors(Table& table, TruthKind truth, const std::string& database, const Runs& runs) {
  for (const int factor : kFactors) {
    const Selection selected = of_factor(runs, factor, database);
    const auto points = mean(sample_of(selected, [](const MeasuredRun& each, size_t frame) {
      return std::optional<double>(each.run.answers[frame].icp_points);
    }));
    std::vector<reports::Cell> row = {std::string(to_string(truth)), database, int64_t{factor}, cell(points)};
    for (const char* metric : {"position_error_mm", "rotation_error_deg"})
      append(row, cells(estimate_mean(sample_of(selected, metric))));
    row.push_back(cell(covered_percent(selected)));
    table.rows.push_back(row);
  }
}

std::optional<double> median(const std::vector<double>& values) { return reports::percentile(values, 0.5); }

void add_times(Table& table, Implementation implementation, const Runs& runs) {
  for (const int factor : kFactors) {
    const Selection selected = of_factor(runs, factor);
    const std::vector<double> frames = times_ms(selected);
    std::vector<reports::Cell> row = {std::string(to_string(implementation)), int64_t{factor}};
    for (const auto& value : {median(frames), reports::percentile(frames, 0.95),
                              median(times_ms(selected, "align")), median(times_ms(selected, "look_up"))})
      row.push_back(cell(value));
    table.rows.push_back(row);
  }
}

/// At the largest factor: alignment compared with all other stages, and the look-up's part of the frame.
std::vector<Measure> time_measures(const Selection& sparsest) {
  const auto frame = median(times_ms(sparsest)), align = median(times_ms(sparsest, "align")),
             look_up = median(times_ms(sparsest, "look_up"));
  if (!frame || !align || !look_up) return {};
  return {{"figure9.time_over_floor", "", *align / (*frame - *align), {}, true},
          {"figure9.look_up_share_at_64", "", *look_up / *frame, {}, true}};
}

std::vector<Measure> sampling_error_measures(const Runs& runs) {
  std::vector<Sample> errors;
  errors.reserve(kFactors.size());
  for (const int factor : kFactors) errors.push_back(sample_of(of_factor(runs, factor), "position_error_mm"));
  const auto per_doubling = [](std::span<const double> means) {
    return std::optional(std::pow(means[1] / means[0], 1.0 / (kFactors.size() - 1)) - 1);
  };
  const auto rise = [](std::span<const double> means) { return std::optional(means[1] - means[0]); };
  const Estimated growth = estimate(std::vector{errors.front(), errors.back()}, per_doubling);
  const Estimated at_16 = estimate(std::vector{errors[0], errors[4]}, rise);
  return {{"figure9.position_rise_per_doubling", "", growth.value, growth.interval},
          {"figure9.position_rise_at_16_mm", "mm", at_16.value, at_16.interval}};
}

}  // namespace

reports::StudyResult run_figure9(const StudyContext& context) {
  reports::StudyResult result{
      "fig9", "Figure 9: sub-sampling", {empty_sampling_errors_table(), empty_times_table()}, {}};
  // No claim uses the recorded truth.
  const TruthKind truth = TruthKind::source;
  const std::vector<Setting> settings = sampling_settings(context.options.tracker);
  for (const auto& [databases, trajectories] : kSampled) {
    const Runs runs = run_study_settings(context, settings, databases, truth, trajectories);
    for (const std::string& database : databases) {
      add_errors(result.tables[0], truth, database, runs);
      if (database == kClaimedDatabase) append(result.measures, sampling_error_measures(runs));
    }
  }
  for (const Implementation implementation : {Implementation::plain, Implementation::fast}) {
    const Runs timed =
        time_settings(context, settings, {kClaimedDatabase}, implementation, kSampled.front().trajectories);
    add_times(result.tables[1], implementation, timed);
    if (implementation == Implementation::plain)
      append(result.measures, time_measures(of_factor(timed, kFactors.back())));
  }
  return result;
}

}  // namespace glovebench::eval
