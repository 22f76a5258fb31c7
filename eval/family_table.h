#pragma once

#include <optional>
#include <span>

#include "eval/measured_run.h"
#include "reports/study.h"

namespace glovebench::eval {

/// Mean errors of generated movements, with Student's 95% intervals over movements, by family, database, hand and
/// noise. Empty without them.
std::optional<reports::StudyResult> family_table(std::span<const MeasuredRun> runs);

}  // namespace glovebench::eval
