#pragma once

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <utility>

namespace glovebench::eval {

/// Text for a person, on stderr. If nobody can read it (a pipe that was closed or is full, a terminal that is
/// gone), nothing happens: no work ends or waits for that. fmt::print would throw.
template <typename... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  const std::string text = fmt::format(format, std::forward<Values>(values)...);
  pollfd to_person = {STDERR_FILENO, POLLOUT, 0};
  if (::poll(&to_person, 1, 0) == 1 && (to_person.revents & POLLOUT))
    std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace glovebench::eval
