#pragma once

#include <span>
#include <vector>

#include "eval/replay.h"
#include "eval/run_folder.h"

namespace glovebench::eval {

using TrackedReplays = std::vector<TrackedReplay>;  ///< of one replay: one a database

/// Checks what the replays name, and makes or loads the hands, databases and color tables: what a mistake in them
/// throws Error for, it throws here.
void prepare(Workbench& workbench, std::span<const Replay> replays);

/// Runs all replays, in any order, on that many threads: an output for each. What comes out does not depend on
/// their number; times do, since threads share the machine. Neighbors that share their images are rendered once.
/// Replays that an interrupted run finished are taken from the run's folder, if there is one, and each that is
/// finished is stored in it.
std::vector<TrackedReplays> replay_all(Workbench& workbench, std::span<const Replay> replays, int threads,
                                       const RunFolder* run_folder = nullptr);

}  // namespace glovebench::eval
