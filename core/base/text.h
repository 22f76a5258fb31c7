#pragma once

// Text that comes from files: as an error of one line shows it, and as a name that may become part of a path.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace glovebench {

// Excerpts are short and in plain ASCII, whatever the file holds.

/// The beginning of a text, with a question mark for each byte that cannot be shown.
std::string printable(std::string_view text);

/// The beginning of a text in quotes, escaped as in JSON: what a name was can be told from it.
std::string quoted_excerpt(std::string_view text);

/// A value; of an array or an object what it is, for what lies in it may be deep.
std::string excerpt(const nlohmann::json& value);

/// The rule for every name that comes from a file and may become part of a path: 1 to 64 letters, digits, '_', '-',
/// '.' or spaces, beginning with a letter or digit. Such a name leads out of no folder and is not hidden in it.
bool is_name(std::string_view text);
inline constexpr const char* kNameExpected =
    "a name of 1 to 64 letters, digits, '_', '-', '.' or spaces that begins with a letter or digit";

/// The name itself. Throws Error naming `where` and `field` unless it is one.
std::string checked_name(std::string name, const std::string& where, const std::string& field);

/// "FOLDER/NAME", for writers: whatever a name is made of, the path stays in the folder. The name may have folders
/// of its own ("tables/figure4.csv"). Throws Error if it is absolute, or a part of it is empty, begins with a dot
/// or holds a control character.
std::string path_within(const std::string& folder, std::string_view name);
/// The same path, for what is created, replaced or removed there. Throws Error also if a folder of the name's own
/// is a symbolic link, which may lead anywhere. What the name itself is does not matter here.
std::string place_within(const std::string& folder, std::string_view name);

}  // namespace glovebench
