#pragma once

#include <string>

#include "core/base/error.h"

namespace glovebench {

/// The message of the exception that an action throws, "" without one.
template <typename Exception = Error, typename Action>
std::string thrown_by(const Action& action) {
  try {
    action();
  } catch (const Exception& e) {
    return e.what();
  }
  return "";
}

}  // namespace glovebench
