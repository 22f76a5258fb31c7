#include "eval/studies/filter_reading.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "eval/studies/sample.h"
#include "reports/paper_numbers.h"

namespace glovebench::eval {
namespace {

using reports::ExperimentResult;
using reports::PaperCurve;
using reports::PaperErrors;
using reports::PaperNumbers;
using reports::RunResult;
using reports::Table;

/// A number of the errors of some noise seeds.
using Statistic = std::optional<double> (*)(const std::vector<ErrorSeries>& seeds);

std::vector<double> all_ratios(const std::vector<ErrorSeries>& seeds) {
  std::vector<double> all;
  for (const ErrorSeries& errors : seeds) std::ranges::copy(falling_ratios(errors), std::back_inserter(all));
  return all;
}

std::optional<double> median_ratio(const std::vector<ErrorSeries>& seeds) {
  return reports::percentile(all_ratios(seeds), 0.5);
}

std::optional<double> percent_of_three_quarters(const std::vector<ErrorSeries>& seeds) {
  std::vector<double> hits;
  for (const double ratio : all_ratios(seeds)) hits.push_back(std::abs(ratio - 0.75) < 0.001 ? 100 : 0);
  return reports::mean(hits);
}

std::optional<double> mean_autocorrelation(const std::vector<ErrorSeries>& seeds) {
  return reports::mean_present(seeds, autocorrelation);
}

std::optional<double> mean_error(const std::vector<ErrorSeries>& seeds) {
  ErrorSeries all;
  for (const ErrorSeries& errors : seeds) all.insert(all.end(), errors.begin(), errors.end());
  return reports::mean_present(all);
}

struct FilterRow {
  const char* name;
  const char* computation;
  PaperCurve PaperNumbers::*curve;
  const char* metric;
  double PaperErrors::*printed;
  Statistic statistic;
};

constexpr const char* kProducts =
    "Sum over the frames of the product of the error's and the next error's difference from the mean, over the sum "
    "of the squares.";
constexpr const char* kMean = "Mean over the frames; a filtered pose lags behind the hand.";
constexpr std::array<FilterRow, 8> kFilterRows = {{
    {"Figure 5, posture: share kept",
     "Median of error / error before, where the error falls and exceeds 0.001 deg.", &PaperNumbers::figure_5,
     "posture_rms_deg", &PaperErrors::posture_deg, median_ratio},
    {"Figure 5, posture: at 0.75, %", "Share of these frames whose ratio is 0.75 to within 0.001.",
     &PaperNumbers::figure_5, "posture_rms_deg", &PaperErrors::posture_deg, percent_of_three_quarters},
    {"Figure 5, rotation: autocorrelation", kProducts, &PaperNumbers::figure_5, "rotation_error_deg",
     &PaperErrors::rotation_deg, mean_autocorrelation},
    {"Figure 5, position: autocorrelation", kProducts, &PaperNumbers::figure_5, "position_error_mm",
     &PaperErrors::position_mm, mean_autocorrelation},
    {"Figure 5, position: mean mm", kMean, &PaperNumbers::figure_5, "position_error_mm", &PaperErrors::position_mm,
     mean_error},
    {"Figure 6, rotation: autocorrelation", kProducts, &PaperNumbers::figure_6, "rotation_error_deg",
     &PaperErrors::rotation_deg, mean_autocorrelation},
    {"Figure 6, position: autocorrelation", kProducts, &PaperNumbers::figure_6, "position_error_mm",
     &PaperErrors::position_mm, mean_autocorrelation},
    {"Figure 6, position: mean mm", kMean, &PaperNumbers::figure_6, "position_error_mm", &PaperErrors::position_mm,
     mean_error},
}};

std::optional<double> printed(const FilterRow& row) {
  ErrorSeries errors;
  for (const PaperErrors& frame : (reports::paper_numbers().*row.curve).frames)
    errors.emplace_back(frame.*row.printed);
  return row.statistic({errors});
}

/// Of the experiment of the curve; empty if it was not run.
std::optional<double> measured(const FilterRow& row, const RunResult& result) {
  const PaperCurve& curve = reports::paper_numbers().*row.curve;
  const ExperimentResult* experiment =
      find_experiment(result, {curve.trajectory, curve.database, reports::TruthKind::recorded, 1, {}});
  if (experiment == nullptr) return std::nullopt;
  std::vector<ErrorSeries> seeds;
  for (const reports::SeedRun& run : experiment->runs) {
    ErrorSeries& errors = seeds.emplace_back();
    for (const reports::FrameRecord& frame : run.frames) errors.push_back(frame[row.metric]);
  }
  return row.statistic(seeds);
}

}  // namespace

std::vector<double> falling_ratios(const ErrorSeries& errors) {
  constexpr double kSmallest = 1e-3;
  std::vector<double> ratios;
  for (size_t f = 1; f < errors.size(); ++f) {
    const std::optional<double>&before = errors[f - 1], &now = errors[f];
    if (before && now && *before > *now && *now > kSmallest) ratios.push_back(*now / *before);
  }
  return ratios;
}

std::optional<double> autocorrelation(const ErrorSeries& errors) {
  const std::optional<double> center = mean_error({errors});
  if (!center) return std::nullopt;
  double products = 0, squares = 0;
  for (size_t f = 0; f < errors.size(); ++f) {
    if (!errors[f]) continue;
    squares += (*errors[f] - *center) * (*errors[f] - *center);
    if (f + 1 < errors.size() && errors[f + 1]) products += (*errors[f] - *center) * (*errors[f + 1] - *center);
  }
  if (squares == 0) return std::nullopt;
  return products / squares;
}

Table filter_table(const std::string& name, const RunResult& paper, const RunResult& literal) {
  Table table = {
      name,
      "Which reading of the filter",
      "Section III-C smooths \"the posture and pose estimation by interpolating with estimations from the "
      "three previous frames\". Profile \"paper\" filters the posture alone, \"paper-literal\" the pose, too; "
      "both keep 3/4 of the previous frame's. Printed: of all frames of the curves in the paper. Beside "
      "it: the same of our runs of these experiments (Tr4 with DB_open_power, Tr1 with DB_20_postures, "
      "recorded truth), whose movements are not the paper's. The rotation errors tell the readings apart in Figure "
      "5, not in Figure 6, where those of both profiles follow each other.",
      {{"statistic", "statistic"},
       {"computation", "computation"},
       {"printed", "printed"},
       {"paper", "paper"},
       {"literal", "paper-literal"}},
      2,
      {}};
  for (const FilterRow& row : kFilterRows)
    table.rows.push_back({std::string(row.name), std::string(row.computation), reports::cell(printed(row)),
                          reports::cell(measured(row, paper)), reports::cell(measured(row, literal))});
  return table;
}

}  // namespace glovebench::eval
