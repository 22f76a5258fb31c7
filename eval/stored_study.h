#pragma once

#include <optional>
#include <string>

#include "reports/study.h"

namespace glovebench::eval {

/// Lossless CBOR.
std::string to_bytes(const reports::StudyResult& study);
/// Empty if `bytes` are no study.
std::optional<reports::StudyResult> study_from_bytes(const std::string& bytes);

}  // namespace glovebench::eval
