#pragma once

#include <optional>
#include <string>

#include "eval/run.h"
#include "reports/study.h"

namespace glovebench::eval {

/// Lossless CBOR, without the spec.
std::string to_bytes(const Run& run);
/// Empty for other bytes.
std::optional<Run> run_from_bytes(const std::string& bytes, const RunSpec& spec);

std::string to_bytes(const reports::StudyResult& study);
std::optional<reports::StudyResult> study_from_bytes(const std::string& bytes);

}  // namespace glovebench::eval
