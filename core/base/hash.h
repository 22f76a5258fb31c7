#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace glovebench {

/// A 128-bit content hash (XXH3) as 32 hexadecimal digits: names caches and identifies inputs. Not a
/// signature: it guards against damage and mix-ups, not against an attacker.
std::string hash_bytes(std::span<const std::byte> bytes);
std::string hash_text(std::string_view text);
/// Hash of a file's content, however large. Throws Error if it cannot be read.
std::string hash_file(const std::string& path);

}  // namespace glovebench
