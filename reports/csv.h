#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace glovebench::reports {

/// An array of plain values as a line of a CSV file (RFC 4180, but with a line feed): null is an empty cell, texts
/// with a comma, a quote or a line break are quoted. A text that a spreadsheet would take for a formula (it begins
/// with
/// '=', '+', '-', '@', a tab or a line break, and is no number) has an apostrophe before it.
std::string csv_line(const nlohmann::ordered_json& cells);

}  // namespace glovebench::reports
