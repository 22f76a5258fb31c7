#pragma once

#include <optional>
#include <string>

#include "reports/study.h"

namespace glovebench::eval {

/// A finished study as bytes (CBOR) from which it comes back equal to the last bit.
std::string to_bytes(const reports::StudyResult& study);
/// Empty if the bytes are those of something else.
std::optional<reports::StudyResult> study_from_bytes(const std::string& bytes);

}  // namespace glovebench::eval
