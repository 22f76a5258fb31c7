#pragma once

#include <optional>
#include <span>

#include "eval/measured_run.h"
#include "reports/study.h"

namespace glovebench::eval {

/// Errors of generated movements by family, database, hand and noise: means with Student's 95% intervals over
/// movements. Empty without such runs.
std::optional<reports::StudyResult> family_table(std::span<const MeasuredRun> runs);

}  // namespace glovebench::eval
