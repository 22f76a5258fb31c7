#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/mapped_memory.h"
#include "core/database/database_file.h"

namespace glovebench {

struct SectionContent {
  std::string hash;
  /// found and expected, for an invalid value
  std::optional<std::pair<std::string, std::string>> fault;
};

struct DatabaseContent {
  std::vector<SectionContent> sections;
  std::map<int, FieldRows> rows;
};

/// Hashes sections and checks values, also of fields that are not stored. `load` also makes rows and keeps a
/// normal database in memory. Uses the caller's TBB arena.
DatabaseContent look_at_sections(const DatabaseLayout& layout, const MappedMemory& file,
                                 std::span<const Section> sections, bool load);

}  // namespace glovebench
