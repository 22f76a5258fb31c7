#pragma once

#include <string>

#include "reports/summary.h"

namespace glovebench::reports {

// Tables to \input into a document that uses the package booktabs. Headings are the tables' own.

/// Text for LaTeX: the characters that mean something there are replaced.
std::string escape_latex(const std::string& text);

/// The rows of `heading` are LaTeX already and stand above the table's own heading, e.g. to span columns.
std::string to_latex(const TextTable& table, const std::string& heading = "");

/// Figure 4 (tables.h): for each variant the mean errors and the coverage, then the paper's printed means.
std::string figure4_latex(const RunResult& result, const PaperNumbers& paper, const NoiseSetting& noise);

}  // namespace glovebench::reports
