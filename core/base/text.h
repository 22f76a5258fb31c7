#pragma once

// Excerpts and suggestions for error messages, and names for paths.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace glovebench {

// Excerpts are beginnings in ASCII.

/// "?" stands for unprintable bytes.
std::string printable(std::string_view text);

/// In quotes, escaped as in JSON.
std::string quoted_excerpt(std::string_view text);

/// A value; of an array or object only the kind.
std::string excerpt(const nlohmann::json& value);

/// "; did you mean NAME?" for the name that takes the fewest edits (a character inserted, removed, replaced, or
/// swapped with its neighbor; upper case equals lower case). Empty if that takes edits of over a third of the
/// characters, or if two names are equally near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

/// "one of horn, robust", with `did_you_mean`.
std::string one_of(const std::vector<std::string>& names, std::string_view found);

/// Whether a name may be part of a path: 1 to 64 letters, digits, '_', '-', '.' or spaces, starting with a letter
/// or digit.
bool is_name(std::string_view text);
inline constexpr const char* kNameExpected =
    "a name of 1 to 64 letters, digits, '_', '-', '.' or spaces that begins with a letter or digit";

/// Returns `name`.
/// Throws: Error unless `is_name`.
std::string checked_name(std::string name, const std::string& where, const std::string& field);

/// "FOLDER/NAME"; the name may contain folders ("tables/figure4.csv").
/// Throws: Error for an absolute name, or a part that is empty, begins with a dot or has control characters.
std::string path_within(const std::string& folder, std::string_view name);
/// As `path_within`, for writing or removing.
/// Throws: Error also if a folder in the name is a symbolic link.
std::string place_within(const std::string& folder, std::string_view name);

}  // namespace glovebench
