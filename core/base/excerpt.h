#pragma once

// What a file holds, as an error of one line shows it: short and in plain ASCII, whatever it is.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace glovebench {

/// The beginning of a text, with a question mark for each byte that cannot be shown.
std::string printable(std::string_view text);

/// The beginning of a text in quotes, escaped as in JSON: what a name was can be told from it.
std::string quoted_excerpt(std::string_view text);

/// A value; of an array or an object what it is, for what lies in it may be deep.
std::string excerpt(const nlohmann::json& value);

}  // namespace glovebench
