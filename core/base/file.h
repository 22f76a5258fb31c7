#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "core/base/whole_file.h"  // IWYU pragma: export: what reads often writes, too

namespace glovebench {

/// The whole content of a file. Throws Error if it is missing, cannot be read or is larger than that.
std::string read_file(const std::string& path, uint64_t max_bytes = std::numeric_limits<uint64_t>::max());

}  // namespace glovebench
