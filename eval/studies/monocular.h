#pragma once

#include <string>
#include <vector>

#include "eval/studies/study.h"

namespace glovebench::eval {

/// The method without depth beside the paper's, with both subjects and these databases; the measure
/// monocular.depth_error_cm is of the first database and of the hand that the tracker knows.
reports::StudyResult measure_monocular(const StudyContext& context, const std::vector<std::string>& databases);

}  // namespace glovebench::eval
