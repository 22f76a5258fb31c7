#pragma once

#include <charconv>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glovebench {

// Excerpts are ASCII and short.

/// Replaces unprintable bytes by "?".
std::string printable(std::string_view text);

/// An excerpt in quotes, escaped as in JSON.
std::string quoted_excerpt(std::string_view text);

/// An excerpt of a value. Of an array or object: only its kind.
std::string excerpt(const nlohmann::json& value);

/// The parts between separators, at least one.
std::vector<std::string_view> split(std::string_view text, char separator);

/// The number that the whole text is, as std::from_chars reads it. Empty for anything else.
template <typename Number>
std::optional<Number> number_in(std::string_view text) {
  Number number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// "; did you mean NAME?" for the nearest name (case is ignored) or the shortest that begins with the word. Empty
/// if none is near, or two are equally good.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

/// "one of horn, robust", with `did_you_mean`.
std::string one_of(const std::vector<std::string>& names, std::string_view found);

/// A safe part of a path: 1 to 64 letters, digits, '_', '-', '.' or spaces; begins with a letter or digit.
bool is_name(std::string_view text);
inline constexpr const char* kNameExpected =
    "a name of 1 to 64 letters, digits, '_', '-', '.' or spaces that begins with a letter or digit";

/// Returns `name`.
/// Throws: Error unless `is_name`.
std::string checked_name(std::string name, const std::string& where, const std::string& field);

/// "FOLDER/NAME". NAME may contain folders.
/// Throws: Error for an absolute name, or a part that is empty, begins with a dot or has control characters.
std::string path_within(const std::string& folder, std::string_view name);
/// The same, for writing or removing.
/// Throws: Error as above, and if a folder in the name is a symbolic link.
std::string place_within(const std::string& folder, std::string_view name);

}  // namespace glovebench
