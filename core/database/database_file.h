#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/base/mapped_memory.h"
#include "core/database/field_rows.h"
#include "core/database/view_sphere.h"
#include "core/hand/posture.h"

namespace glovebench {

inline constexpr int kDatabaseVersion = 5;

struct DatabaseHeader {
  PostureSet postures;
  Side side = Side::right;
  std::string input_hash;
  DatabaseMemory memory = DatabaseMemory::normal;
  double field_cap_share = 0;
  std::set<int> sizes_px;
};

struct Section {
  enum class Kind { box_rays, labels, fields };

  Kind kind = Kind::box_rays;
  int size_px = 0;  ///< 0: all sizes
  uint64_t offset = 0;
  uint64_t bytes = 0;  ///< 0: fields of low memory, only hashed
  uint64_t piece_bytes = 0;

  std::string name() const;
};
struct SizeSections {
  Section labels;  ///< [entry][packed_bytes(pixels)]
  Section fields;  ///< [entry][color][pixel]
};

/// A database's bytes, little-endian: magic, length and checksum of a JSON header, the header, then sections of
/// whole pages, each with at least kBehind zero bytes behind.
class DatabaseLayout {
 public:
  static constexpr uint64_t kBehind = 64;
  static constexpr int kPieceEntries = 54;

  explicit DatabaseLayout(DatabaseHeader header);
  /// Throws: Error unless the bytes are a whole database.
  DatabaseLayout(std::span<const uint8_t> file, const std::string& path);

  const DatabaseHeader& header() const { return header_; }
  uint64_t bytes() const { return bytes_; }
  const Section& box_rays() const { return box_rays_; }
  const std::map<int, SizeSections>& sizes() const { return sizes_; }
  int entry_count() const { return static_cast<int>(header_.postures.postures.size()) * kViewCount; }
  /// Sections in file order, also of fields that are not stored.
  std::vector<Section> sections() const;
  /// Hash of angles, box rays, labels and fields. Memory modes do not change it.
  std::string content_hash() const;

  /// Writes the header with hashes.
  void seal(MappedMemory& file);
  /// Checks the sections of these sizes and makes their rows.
  /// Throws: Error for a wrong hash or value.
  std::map<int, FieldRows> read_sections(const MappedMemory& file, const std::string& path,
                                         std::span<const int> sizes_px) const;

 private:
  void place(uint64_t header_bytes);
  std::string header_text() const;

  DatabaseHeader header_;
  Section box_rays_;
  std::map<int, SizeSections> sizes_;
  uint64_t bytes_ = 0;
  std::map<std::string, std::string> hashes_;
};

}  // namespace glovebench
