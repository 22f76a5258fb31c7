#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "reports/results.h"

namespace glovebench::reports {

/// Names and values of the columns in which a frame is written, in results.json and in the CSV files.
std::vector<std::string> frame_columns(std::span<const std::string> metric_keys);
nlohmann::ordered_json frame_row(const FrameRecord& frame, std::span<const std::string> metric_keys);

/// results.json, as reports/schema/results.schema.json describes it, with the metrics of the protocol that this
/// program knows. Values are rounded to 1e-6 of their unit; equal results are equal bytes.
std::string results_json(const RunResult& result);
void write_results(const std::string& path, const RunResult& result);

/// Reads results.json back. Metrics that the program does not know are left out, but for their keys in the
/// protocol; those that the file lacks are empty. Throws Error for whatever write_results does not write: another
/// format or version, missing and unknown keys, wrong kinds, a protocol id or counts that do not fit the content.
RunResult read_results(const std::string& path);
/// The same for the file's text; `where` names it in errors.
RunResult parse_results(const std::string& text, const std::string& where);

inline constexpr std::string_view kResultsFormat = "glovebench-results";
inline constexpr int kResultsVersion = 2;

}  // namespace glovebench::reports
