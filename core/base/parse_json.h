#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace glovebench {

/// What is nested deeper is refused before it takes the stack.
inline constexpr size_t kDeepestNesting = 64;

/// Parses strictly: no comments, no NaN or Infinity, no number that no double can hold, no key twice in one object,
/// nothing nested deeper than kDeepestNesting. Throws Error(where, place or key, found, expected).
nlohmann::json parse_json(std::string_view text, const std::string& where);

}  // namespace glovebench
