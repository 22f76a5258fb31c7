#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/base/mapped_memory.h"
#include "core/database/database_memory.h"
#include "core/database/posture_set.h"

namespace glovebench {

/// Of the file. A database of another version is refused.
inline constexpr int kDatabaseVersion = 3;

/// What the header of a database's file says.
struct DatabaseHeader {
  PostureSet postures;
  Side side = Side::right;
  std::string hash;  ///< of all inputs
  DatabaseMemory memory = DatabaseMemory::normal;
  double field_cap_share = 0;  ///< as in the view configuration: what made fields are capped at
  std::set<int> sizes_px;      ///< the tiny images'
};

/// A part of the file.
struct Section {
  uint64_t offset = 0, bytes = 0;
};
/// Of the tiny images of one size.
struct SizeSections {
  Section labels;  ///< [entry][packed_bytes(pixels)], as pack_labels
  Section fields;  ///< [entry][color][pixel]; none in a low-memory database
  Section rows;    ///< as FieldRows
};

/// The bytes of a database, in its file and in memory: magic, length and checksum of a JSON header, the header,
/// then sections, each of whole pages and followed by at least kBehind bytes that are zero. Where a section lies
/// follows from the postures, the sizes and what is held of a view. Little-endian.
class DatabaseLayout {
 public:
  /// What may be read behind the last value of a section, bytes.
  static constexpr uint64_t kBehind = 64;

  /// Of a database that is to be made.
  explicit DatabaseLayout(DatabaseHeader header);
  /// Of a file's bytes. Throws Error naming `path` if they are not those of a whole file.
  DatabaseLayout(std::span<const uint8_t> file, const std::string& path);

  const DatabaseHeader& header() const { return header_; }
  uint64_t bytes() const { return bytes_; }
  const Section& box_rays() const { return box_rays_; }
  const std::map<int, SizeSections>& sizes() const { return sizes_; }

  /// Writes the header with the checksums of the sections, which are complete. Keeps no page of a file resident.
  void seal(MappedMemory& file) const;
  /// Throws Error naming `path` if a section that all databases have, or one of these sizes, is not what was
  /// sealed. Keeps no page of a low-memory database resident.
  void check_sections(const MappedMemory& file, const std::string& path, std::span<const int> sizes_px) const;

 private:
  struct Chunk {
    std::string section;
    int size_px = 0;  ///< of the tiny images; 0: of all
    uint64_t offset = 0, bytes = 0;
  };
  /// Places the sections behind a header of that many bytes.
  void place(uint64_t header_bytes);
  /// What each checksum is of: so much of a section that threads share the work.
  std::vector<Chunk> chunks() const;
  std::string header_text(const std::vector<std::string>& checksums) const;

  DatabaseHeader header_;
  Section box_rays_;
  std::map<int, SizeSections> sizes_;
  uint64_t bytes_ = 0;
  std::vector<std::string> checksums_;  ///< of `chunks`; empty until sealed
};

}  // namespace glovebench
