#pragma once

#include "core/base/enum_names.h"

namespace glovebench {

/// What a database holds of a view beside its labels. `normal`: its distance fields, and in memory their least
/// values over 4 x 4 pixels. `low`: in memory the least values over up to 8 x 8 pixels alone; fields are made of
/// the labels when a look-up asks for them. The matches are the same.
enum class DatabaseMemory { normal, low };
constexpr auto names_of(DatabaseMemory) {
  return std::to_array<std::string_view>({"normal", "low"});
}

}  // namespace glovebench
