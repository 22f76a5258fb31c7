#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace glovebench {

/// An enumeration 0, 1, 2, ... with `constexpr auto names_of(Color) { return
/// std::to_array<std::string_view>({"red", "green"}); }`
template <typename Enum>
concept Named = std::is_enum_v<Enum> && requires(Enum value) {
  names_of(value).size();
};

template <Named Enum>
inline constexpr auto kNamesOf = names_of(Enum());

template <Named Enum>
inline constexpr int kCountOf = static_cast<int>(kNamesOf<Enum>.size());

/// A namespace with its own `to_string` needs `using glovebench::to_string`.
/// Throws: std::out_of_range without a name.
template <Named Enum>
constexpr std::string_view to_string(Enum value) {
  return kNamesOf<Enum>.at(static_cast<size_t>(value));
}

template <Named Enum>
constexpr std::optional<Enum> from_name(std::string_view name) {
  for (size_t i = 0; i < kNamesOf<Enum>.size(); ++i)
    if (kNamesOf<Enum>[i] == name) return static_cast<Enum>(i);
  return std::nullopt;
}

template <Named Enum>
constexpr std::array<Enum, kNamesOf<Enum>.size()> all_values() {
  std::array<Enum, kNamesOf<Enum>.size()> values;
  for (size_t i = 0; i < values.size(); ++i) values[i] = static_cast<Enum>(i);
  return values;
}

template <Named Enum>
std::vector<std::string> all_names() {
  return {kNamesOf<Enum>.begin(), kNamesOf<Enum>.end()};
}

/// "red, green or blue"
template <Named Enum>
std::string known_names() {
  std::string text;
  for (size_t i = 0; i < kNamesOf<Enum>.size(); ++i) {
    if (i > 0) text += i + 1 < kNamesOf<Enum>.size() ? ", " : " or ";
    text += kNamesOf<Enum>[i];
  }
  return text;
}

}  // namespace glovebench
