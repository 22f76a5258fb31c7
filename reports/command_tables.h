#pragma once

#include <string>

#include "reports/summary.h"
#include "reports/timings.h"

namespace glovebench::reports {

bool has_commands(const RunResult& result);

std::string command_explanation();
Table command_stream_table(const RunResult& result);
/// By reason. No rows without interventions.
Table command_intervention_table(const RunResult& result);
/// Errors against the truth's commands, and smoothness.
Table command_error_table(const RunResult& result);
/// Time from frame to command. No rows without times.
Table command_latency_table(const RunResult& result, const Timings& timings);

/// tables/commands.csv, without times.
std::string commands_csv(const RunResult& result);
/// For summary.md. Empty without commands.
std::string commands_markdown(const RunResult& result);

}  // namespace glovebench::reports
