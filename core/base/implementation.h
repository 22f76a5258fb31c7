#pragma once

#include "core/base/enum_names.h"

namespace glovebench {

/// Equal results: `plain` follows the paper line by line, `fast` is for use.
enum class Implementation { plain, fast };
constexpr auto names_of(Implementation) {
  return std::to_array<std::string_view>({"plain", "fast"});
}

}  // namespace glovebench
