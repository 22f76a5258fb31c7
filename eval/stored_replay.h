#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/replay.h"

namespace glovebench::eval {

/// A finished replay as bytes (CBOR) from which it comes back equal to the last bit.
std::string to_bytes(const std::vector<TrackedReplay>& replay);
/// Empty if the bytes are those of something else.
std::optional<std::vector<TrackedReplay>> replay_from_bytes(const std::string& bytes);

}  // namespace glovebench::eval
