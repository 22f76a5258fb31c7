#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/replay.h"

namespace glovebench::eval {

/// A finished replay as bytes from which it comes back equal to the last bit: a line with format, version and
/// checksum, then CBOR. The key is part of it, so that a file under a wrong name is none.
std::string to_bytes(const std::string& key, const std::vector<TrackedReplay>& replay);
/// Empty unless the bytes are whole, of this version and of that key.
std::optional<std::vector<TrackedReplay>> from_bytes(const std::string& key, const std::string& bytes);

}  // namespace glovebench::eval
