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

/// What a pass over sections found.
struct SectionContent {
  std::string hash;
  /// What is found and what was expected, of a value that no database has.
  std::optional<std::pair<std::string, std::string>> fault;
};

struct DatabaseContent {
  std::vector<SectionContent> sections;  ///< one a section that was looked at
  std::map<int, FieldRows> rows;         ///< by size
};

/// Hashes sections of a file and looks at each value: box rays are unit vectors before the camera, labels those of
/// the glove, distances at most the cap. Fields that the file does not store are made of the labels, and hashed as
/// if they were stored. `load`: makes rows of all fields among the sections, and keeps the pages of a normal
/// database resident. Uses the threads of the caller's TBB arena.
DatabaseContent look_at_sections(const DatabaseLayout& layout, const MappedMemory& file,
                                 std::span<const Section> sections, bool load);

}  // namespace glovebench
