#pragma once

#include <stdexcept>
#include <string>

namespace glovebench {

/// Bad input at an edge of the program: a file, a configuration, a command line, a device.
/// The message is one line that names where it was, which field, what was found and what was expected.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
  /// "WHERE: FIELD: found FOUND, expected EXPECTED"
  Error(const std::string& where, const std::string& field, const std::string& found, const std::string& expected)
      : std::runtime_error(where + ": " + field + ": found " + found + ", expected " + expected) {}
};

/// A broken invariant of the program itself; stays on in release builds.
inline void check(bool condition, const char* what) {
  if (!condition) throw std::logic_error(std::string("broken invariant: ") + what);
}

}  // namespace glovebench
