#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace glovebench {

/// 128-bit XXH3 in hexadecimal. Detects damage, not attacks.
std::string hash_bytes(std::span<const std::byte> bytes);
std::string hash_text(std::string_view text);
/// Throws: Error if the file is unreadable.
std::string hash_file(const std::string& path);

}  // namespace glovebench
