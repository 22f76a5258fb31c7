#pragma once

#include "core/base/enum_names.h"

namespace glovebench {

/// Which of two implementations of the same stage, whose answers are equal: the one that follows the paper line by
/// line, or the one to use.
enum class Implementation { plain, fast };
constexpr auto names_of(Implementation) {
  return std::to_array<std::string_view>({"plain", "fast"});
}

}  // namespace glovebench
