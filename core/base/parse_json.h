#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace glovebench {

/// What is nested deeper is refused before it takes the stack.
inline constexpr size_t kDeepestNesting = 64;

/// Memory that a document may take, while it is built, kept and thrown away: so much for any text, and so much for
/// each byte of a text. Our files take 3 to 10 bytes for a byte; `[[],[],[]]` would take 30.
inline constexpr uint64_t kJsonBytes = uint64_t{8} << 20;
inline constexpr uint64_t kJsonBytesPerByte = 12;
inline constexpr uint64_t kCborBytesPerByte = 64;

/// Parses strictly: no comments, no NaN or Infinity, no number that no double can hold, no key twice in one object,
/// nothing nested deeper than kDeepestNesting, no more memory than above. Throws Error(where, place or key, found,
/// expected).
nlohmann::json parse_json(std::string_view text, const std::string& where);
/// The same for CBOR, where values take as little as a byte: kCborBytesPerByte.
nlohmann::json parse_cbor(std::string_view bytes, const std::string& where);

}  // namespace glovebench
