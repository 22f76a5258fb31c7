#pragma once

#include <stdexcept>
#include <string>

namespace glovebench {

/// Bad input from outside, in one line. `where` names its source.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
  Error(const std::string& where, const std::string& field, const std::string& found, const std::string& expected)
      : std::runtime_error(where + ": " + field + ": found " + found + ", expected " + expected) {}
};

/// Throws: std::logic_error, in release builds too, if an invariant is broken.
inline void check(bool condition, const char* what) {
  if (!condition) throw std::logic_error(std::string("broken invariant: ") + what);
}

}  // namespace glovebench
