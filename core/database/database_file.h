#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/base/mapped_memory.h"
#include "core/database/field_rows.h"
#include "core/database/posture_set.h"
#include "core/database/view_sphere.h"

namespace glovebench {

/// Of the file. A database of another version is refused.
inline constexpr int kDatabaseVersion = 5;

/// What the header of a database's file says.
struct DatabaseHeader {
  PostureSet postures;
  Side side = Side::right;
  std::string input_hash;  ///< of all inputs
  DatabaseMemory memory = DatabaseMemory::normal;
  double field_cap_share = 0;  ///< as in the view configuration: what made fields are capped at
  std::set<int> sizes_px;      ///< the tiny images'
};

/// A part of the file. Its hash is that of the hashes of its pieces, so that threads share the work.
struct Section {
  enum class Kind { box_rays, labels, fields };

  Kind kind = Kind::box_rays;
  int size_px = 0;  ///< of the tiny images; 0: of all
  uint64_t offset = 0;
  uint64_t bytes = 0;        ///< 0: the fields of a low-memory database, of which the file holds the hash alone
  uint64_t piece_bytes = 0;  ///< of kPieceEntries entries, also where the file holds none

  std::string name() const;  ///< "fields_16"
};
/// Of the tiny images of one size.
struct SizeSections {
  Section labels;  ///< [entry][packed_bytes(pixels)], as pack_labels
  Section fields;  ///< [entry][color][pixel]; none in a low-memory database
};

/// The bytes of a database, in its file and in memory: magic, length and checksum of a JSON header, the header,
/// then sections, each of whole pages and followed by at least kBehind bytes that are zero. Where a section lies
/// follows from the postures, the sizes and what is held of a view. Little-endian.
class DatabaseLayout {
 public:
  /// What may be read behind the last value of a section, bytes.
  static constexpr uint64_t kBehind = 64;
  /// Entries in a piece of a section.
  static constexpr int kPieceEntries = 54;

  /// Of a database that is to be made.
  explicit DatabaseLayout(DatabaseHeader header);
  /// Of a file's bytes. Throws Error naming `path` if they are not those of a whole file.
  DatabaseLayout(std::span<const uint8_t> file, const std::string& path);

  const DatabaseHeader& header() const { return header_; }
  uint64_t bytes() const { return bytes_; }
  const Section& box_rays() const { return box_rays_; }
  const std::map<int, SizeSections>& sizes() const { return sizes_; }
  int entry_count() const { return static_cast<int>(header_.postures.postures.size()) * kViewCount; }
  /// In the order in which they lie; also the fields that a low-memory database does not store.
  std::vector<Section> sections() const;
  /// Hash of the postures' angles, box rays, labels and fields: equal for databases that give the same matches,
  /// whoever built them, and for normal and low memory. Once sealed.
  std::string content_hash() const;

  /// Writes the header with the hashes of the sections, which are complete. Keeps no page of a file resident.
  void seal(MappedMemory& file);
  /// Reads the sections that all databases have and those of these sizes, and makes the rows of the sizes' fields
  /// on the way. Throws Error naming `path` if a section is not what was sealed, or holds a value that no database
  /// has. Keeps no page of a low-memory database resident.
  std::map<int, FieldRows> read_sections(const MappedMemory& file, const std::string& path,
                                         std::span<const int> sizes_px) const;

 private:
  /// Places the sections behind a header of that many bytes.
  void place(uint64_t header_bytes);
  std::string header_text() const;

  DatabaseHeader header_;
  Section box_rays_;
  std::map<int, SizeSections> sizes_;
  uint64_t bytes_ = 0;
  std::map<std::string, std::string> hashes_;  ///< by the section's name
};

}  // namespace glovebench
