#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

/// Columns in results.json and CSV files.
std::vector<std::string> frame_columns(std::span<const std::string> metric_keys);
nlohmann::ordered_json frame_row(const FrameRecord& frame, std::span<const std::string> metric_keys);

/// Follows reports/schema/results.schema.json. Rounds to 1e-6, omits unknown metrics. Equal results give equal
/// bytes.
std::string results_json(const RunResult& result);
void write_results(const std::string& path, const RunResult& result);

/// Drops unknown metrics, but keeps their protocol keys. Missing metrics are empty.
/// Throws: Error, also for a wrong protocol id or count.
RunResult read_results(const std::string& path);
RunResult parse_results(const std::string& text, const std::string& where);

inline constexpr std::string_view kResultsFormat = "glovebench-results";
inline constexpr int kResultsVersion = 2;

}  // namespace glovebench::reports
