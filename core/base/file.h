#pragma once

#include <cstdint>
#include <string>

#include "core/base/whole_file.h"  // IWYU pragma: export: what reads often writes, too

namespace glovebench {

/// Files are refused from this size on where nobody says what they may hold.
inline constexpr uint64_t kLargestUnknownFile = uint64_t{256} << 20;

/// The whole content of a regular file or a pipe (InputFile). Throws Error if it is missing, cannot be read or is
/// larger than `max_bytes`, of which a reader says how many its files may have (core/README.md).
std::string read_file(const std::string& path, uint64_t max_bytes = kLargestUnknownFile);
/// The same of a file that a folder brings along, which nobody named: a pipe is refused, since its reader would
/// wait for a writer that may never come.
std::string read_regular_file(const std::string& path, uint64_t max_bytes = kLargestUnknownFile);

}  // namespace glovebench
