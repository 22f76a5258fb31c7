#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace glovebench::eval {

/// Text for a person, on stderr. If nobody can read it (a pipe that was closed, a terminal that is gone), nothing
/// happens: no work ends for that. fmt::print would throw.
template <typename... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  const std::string text = fmt::format(format, std::forward<Values>(values)...);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace glovebench::eval
