#pragma once

#include <optional>
#include <string_view>

namespace glovebench {

/// What a database holds of a view beside its labels. `normal`: its distance fields, and in memory their least
/// values over 4 x 4 pixels. `low`: in memory the least values over up to 8 x 8 pixels alone; fields are made of
/// the labels when a look-up asks for them. The matches are the same.
enum class DatabaseMemory { normal, low };

constexpr std::string_view to_string(DatabaseMemory memory) {
  return memory == DatabaseMemory::normal ? "normal" : "low";
}
constexpr std::optional<DatabaseMemory> database_memory_from_string(std::string_view text) {
  for (const DatabaseMemory memory : {DatabaseMemory::normal, DatabaseMemory::low})
    if (text == to_string(memory)) return memory;
  return std::nullopt;
}

}  // namespace glovebench
