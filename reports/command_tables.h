#pragma once

#include <string>

#include "reports/summary.h"
#include "reports/timings.h"

namespace glovebench::reports {

/// Was there any robot command in these experiments?
bool has_commands(const RunResult& result);

/// What the tables of robot commands hold, in one paragraph of plain text.
std::string command_explanation();
/// One row an experiment: how many commands, how often, in which state.
Table command_stream_table(const RunResult& result);
/// One row an experiment: how many commands were changed or refused, a column for each reason that there was. No
/// rows where there was none.
Table command_intervention_table(const RunResult& result);
/// One row an experiment: how far the commands are from the truth's, and how smooth both are.
Table command_error_table(const RunResult& result);
/// One row an experiment: the time from a frame to its command. No rows where no time was taken.
Table command_latency_table(const RunResult& result, const Timings& timings);

/// All of it but the times, one line an experiment: tables/commands.csv.
std::string commands_csv(const RunResult& result);
/// A section of summary.md; empty if there are no commands.
std::string commands_markdown(const RunResult& result);

}  // namespace glovebench::reports
