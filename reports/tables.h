#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/paper_numbers.h"
#include "reports/results.h"
#include "reports/table.h"

namespace glovebench::reports {

/// Figure 4 on recorded truth, source truth, and source truth with subject 2.
struct Variant {
  std::string title;
  TruthKind truth;
  int subject;
};
const std::array<Variant, 3>& figure4_variants();

/// Databases for Tr1 to Tr5: the one for its grasp first, the largest last. Empty names for other trajectories.
std::array<std::string, 3> figure4_databases(std::string_view trajectory);
/// True if there are experiments, all of Figure 4 (any noise).
bool is_figure4(const RunResult& result);

/// Pointers are null where not run.
struct Figure4Row {
  std::string trajectory;
  std::string database;
  std::array<const ExperimentResult*, 3> variants{};
  const PaperErrors* paper = nullptr;
};
/// In running order. Rows refer to both arguments.
std::vector<Figure4Row> figure4_rows(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise);

/// Variants beside the paper; below each other for fewer than 115 `columns`.
std::string figure4_table(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise,
                          size_t columns = 120);

/// One column per variant, one for the paper.
Table figure4_summary(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise);
/// One column per number. A comment names the run.
std::string figure4_latex(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise);
/// One line per experiment, with intervals and the paper's numbers.
std::string figure4_csv(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise);
/// As `figure4_csv`, for all experiments, without the paper's numbers.
std::string errors_csv(const RunResult& result);
/// The means of `detail_summary`, one line per experiment.
std::string metrics_csv(const RunResult& result);

/// Percent of all frames.
std::optional<double> covered_percent(const ExperimentResult& experiment);

/// Columns "run" (run_name), "experiment" to "noise_factor". Each CSV begins with the first two.
nlohmann::ordered_json experiment_columns();
nlohmann::ordered_json experiment_cells(const std::string& run, const ExperimentKey& key);

/// Columns: run, experiment, seed, frame_columns.
std::string frames_csv(const std::string& run, const ExperimentResult& experiment);
/// Errors per frame beside the paper's, which are of another movement.
std::string curve_csv(const std::string& run, const ExperimentResult& experiment, const PaperCurve& paper);
/// CSV texts for the page's charts, by name: "figure4" is tables/figure4.csv.
nlohmann::ordered_json csv_tables(const RunResult& result, const PaperNumbers& paper);

}  // namespace glovebench::reports
