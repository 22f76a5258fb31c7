#pragma once

#include <string>
#include <string_view>

namespace glovebench {

/// The whole content of a file. Throws Error if it is missing or cannot be read.
std::string read_file(const std::string& path);

/// Writes a file whole: to a temporary name beside the target, flushed, then renamed, so that a reader sees
/// the old content or the new one and a full disk leaves the old one. Creates missing folders. Throws Error.
void write_file(const std::string& path, std::string_view content);

}  // namespace glovebench
