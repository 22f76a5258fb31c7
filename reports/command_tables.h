#pragma once

#include <string>

#include "reports/summary.h"
#include "reports/timings.h"

namespace glovebench::reports {

/// Whether any experiment has robot commands.
bool has_commands(const RunResult& result);

/// What the tables below hold, as one paragraph of plain text.
std::string command_explanation();
/// One row per experiment: count, rate and states.
Table command_stream_table(const RunResult& result);
/// One row per experiment: changed or refused commands, one column per reason that occurred. No rows if none was.
Table command_intervention_table(const RunResult& result);
/// One row per experiment: errors against the truth's commands, and smoothness of both.
Table command_error_table(const RunResult& result);
/// One row per experiment: time from frame to command. No rows without times.
Table command_latency_table(const RunResult& result, const Timings& timings);

/// tables/commands.csv: all of it except times, one line per experiment.
std::string commands_csv(const RunResult& result);
/// Section of summary.md; empty without commands.
std::string commands_markdown(const RunResult& result);

}  // namespace glovebench::reports
