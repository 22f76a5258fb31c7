#pragma once

#include <optional>
#include <string_view>

namespace glovebench {

/// Which of two implementations of the same stage, whose answers are equal: the one that follows the paper line by
/// line, or the one to use.
enum class Implementation { plain, fast };

constexpr std::string_view to_string(Implementation implementation) {
  return implementation == Implementation::plain ? "plain" : "fast";
}

constexpr std::optional<Implementation> implementation_from_string(std::string_view text) {
  for (const Implementation implementation : {Implementation::plain, Implementation::fast})
    if (text == to_string(implementation)) return implementation;
  return std::nullopt;
}

}  // namespace glovebench
