#pragma once

#include <stdexcept>
#include <string>

namespace glovebench {

/// A broken invariant of the program itself; stays on in release builds.
inline void check(bool condition, const char* what) {
  if (!condition) throw std::logic_error(std::string("broken invariant: ") + what);
}

}  // namespace glovebench
