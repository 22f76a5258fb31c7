#pragma once

#include <array>
#include <string>
#include <vector>

#include "reports/paper_numbers.h"
#include "reports/results.h"
#include "reports/table.h"

namespace glovebench::reports {

/// Figure 4 against recorded truth, source truth, and source truth with subject 2.
struct Variant {
  std::string title;
  TruthKind truth;
  int subject;
};
const std::array<Variant, 3>& figure4_variants();

/// One trajectory with one database; null where not run.
struct Figure4Row {
  std::string trajectory;
  std::string database;
  std::array<const ExperimentResult*, 3> variants{};
  const PaperErrors* paper = nullptr;
};
/// In running order. Rows refer to both arguments.
std::vector<Figure4Row> figure4_rows(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise);

/// At most 120 columns: position, posture (RMS) and rotation errors with coverage per variant, beside the paper's.
/// "-" for no value.
std::string figure4_table(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise);

/// One column per variant, one for the paper's means.
Table figure4_summary(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise);
/// One column per number.
std::string figure4_latex(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise);
/// One line per experiment, with intervals and the paper's numbers.
std::string figure4_csv(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise);

/// Every frame: the seed, then frame_columns. Empty cells have no value.
std::string frames_csv(const ExperimentResult& experiment);
/// Errors of Figure 5 or 6 per frame, beside the paper's, which are of another movement.
std::string curve_csv(const ExperimentResult& experiment, const PaperCurve& paper);
/// Data of the page's charts as CSV: Figure 4, Figures 5 and 6 if run, studies' tables. "figure4" is
/// tables/figure4.csv.
nlohmann::ordered_json csv_tables(const RunResult& result, const PaperNumbers& paper);

}  // namespace glovebench::reports
