#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/mapped_memory.h"
#include "core/database/database_file.h"

namespace glovebench {

/// Hash of a piece of a section.
std::string piece_hash(std::span<const uint8_t> piece);
/// Hash of a section whose pieces have these.
std::string section_hash(std::span<const std::string> piece_hashes);

/// What a pass over sections found.
struct SectionContent {
  std::string hash;
  /// What is found and what was expected, of a value that no database has.
  std::optional<std::pair<std::string, std::string>> fault;
};

/// Hashes sections and looks at each value: box rays are unit vectors before the camera, labels those of the glove,
/// distances at most the cap. One answer a section. Uses the threads of the caller's TBB arena. `release`: keeps no
/// page resident.
std::vector<SectionContent> look_at_sections(const MappedMemory& file, std::span<const Section> sections,
                                             double field_cap_share, bool release);

}  // namespace glovebench
