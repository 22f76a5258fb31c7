#pragma once

#include <optional>
#include <span>

#include "eval/measured_run.h"
#include "reports/study.h"

namespace glovebench::eval {

/// The errors of generated movements by family, as a table: a row for each family, database, hand and noise, with
/// means over movements and their 95% intervals (Student's t over movements). Empty if no run is of a family.
std::optional<reports::StudyResult> family_table(std::span<const MeasuredRun> runs);

}  // namespace glovebench::eval
