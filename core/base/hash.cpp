#include "core/base/hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include "core/base/file.h"

namespace glovebench {

std::string hash_bytes(std::span<const std::byte> bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string hash_text(std::string_view text) {
  return hash_bytes(std::as_bytes(std::span(text)));
}

std::string hash_file(const std::string& path) {
  return hash_text(read_file(path));
}

}  // namespace glovebench
