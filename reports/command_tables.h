#pragma once

#include <string>

#include "reports/summary.h"
#include "reports/timings.h"

namespace glovebench::reports {

/// Whether any experiment has robot commands.
bool has_commands(const RunResult& result);

/// What the tables below hold. Each has one row per experiment.
std::string command_explanation();
/// Count, rate and states.
Table command_stream_table(const RunResult& result);
/// Changed or refused commands, by reason. No rows if there are none.
Table command_intervention_table(const RunResult& result);
/// Errors against the truth's commands, and smoothness.
Table command_error_table(const RunResult& result);
/// Time from frame to command. No rows without times.
Table command_latency_table(const RunResult& result, const Timings& timings);

/// tables/commands.csv, without times.
std::string commands_csv(const RunResult& result);
/// Section of summary.md; empty without commands.
std::string commands_markdown(const RunResult& result);

}  // namespace glovebench::reports
