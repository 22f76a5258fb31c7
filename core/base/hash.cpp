#include "core/base/hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <memory>
#include <vector>

#include "core/base/input_file.h"

namespace glovebench {
namespace {

std::string to_text(const XXH128_hash_t& hash) { return fmt::format("{:016x}{:016x}", hash.high64, hash.low64); }

}  // namespace

std::string hash_bytes(std::span<const std::byte> bytes) {
  return to_text(XXH3_128bits(bytes.data(), bytes.size()));
}

std::string hash_text(std::string_view text) { return hash_bytes(std::as_bytes(std::span(text))); }

std::string hash_file(const std::string& path) {
  InputFile file(path);
  const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(), &XXH3_freeState);
  XXH3_128bits_reset(state.get());
  std::vector<char> chunk(1 << 20);
  while (const size_t bytes = file.read(chunk)) XXH3_128bits_update(state.get(), chunk.data(), bytes);
  return to_text(XXH3_128bits_digest(state.get()));
}

}  // namespace glovebench
