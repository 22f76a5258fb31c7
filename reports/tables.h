#pragma once

#include <array>
#include <string>
#include <vector>

#include "reports/paper_numbers.h"
#include "reports/results.h"
#include "reports/table.h"

namespace glovebench::reports {

/// The three ways in which Figure 4 is run: against the recorded truth, against the source, and against the source
/// with the second subject's hand.
struct Variant {
  std::string title;
  TruthKind truth;
  int subject;
};
const std::array<Variant, 3>& figure4_variants();

/// A trajectory with a database: a bar of Figure 4 for each variant. Null where there is no such experiment.
struct Figure4Row {
  std::string trajectory;
  std::string database;
  std::array<const ExperimentResult*, 3> variants{};
  const PaperErrors* paper = nullptr;
};
/// The rows of the experiments with that noise, in the order in which they were run. They refer to both arguments.
std::vector<Figure4Row> figure4_rows(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise);

/// Figure 4 as aligned text of at most 120 columns: for each variant mean position error, posture error (RMS) and
/// rotation error with coverage, beside the paper's printed means. "-" where there is no value.
std::string figure4_table(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise);

/// The same rows: a column for each variant and one for the paper's means.
Table figure4_summary(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise);
/// The same rows as a LaTeX tabular: a column for each number.
std::string figure4_latex(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise);
/// The same rows, one line an experiment, with the intervals of the means and the paper's numbers.
std::string figure4_csv(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise);

/// Every frame of an experiment, seed after seed: the columns of frame_columns after the seed's. Empty cells are
/// values that a frame does not have.
std::string frames_csv(const ExperimentResult& experiment);
/// The three errors of figures 5 and 6, frame by frame, beside those that the paper printed (another movement:
/// frames of the same number have nothing in common but their place in the curve).
std::string curve_csv(const ExperimentResult& experiment, const PaperCurve& paper);
/// What a page's charts are drawn from, as texts of CSV files: "figure4" is tables/figure4.csv. Figure 4, the
/// curves of figures 5 and 6 that were run, and the studies' tables.
nlohmann::ordered_json csv_tables(const RunResult& result, const PaperNumbers& paper);

}  // namespace glovebench::reports
