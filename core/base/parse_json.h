#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace glovebench {

inline constexpr size_t kDeepestNesting = 64;

/// Limits of a document's memory: constant, and per byte of text.
inline constexpr uint64_t kJsonBytes = uint64_t{8} << 20;
inline constexpr uint64_t kJsonBytesPerByte = 12;
inline constexpr uint64_t kCborBytesPerByte = 64;

/// Parses strictly: no comments, NaN, Infinity, repeated keys, or numbers beyond a double.
/// Throws: Error, also beyond the limits above.
nlohmann::json parse_json(std::string_view text, const std::string& where);
nlohmann::json parse_cbor(std::string_view bytes, const std::string& where);

}  // namespace glovebench
