#pragma once

// A small database's file without a hand, a renderer or a mesh, and files whose checksums are right all the same:
// for tests and the fuzz target.

#include <cstring>
#include <string>

#include "core/base/hash.h"
#include "core/database/database.h"
#include "core/database/packed_labels.h"
#include "core/database/section_check.h"

namespace glovebench {

/// The file of a database of one posture, whose 756 views are two painted blocks each. Rows behind the last entry
/// are 0.
inline std::string painted_database(DatabaseMemory memory, std::set<int> sizes_px) {
  DatabaseLayout layout({.postures = {"DB_painted", {"open"}, {Posture::Zero()}},
                         .side = Side::right,
                         .input_hash = "painted",
                         .memory = memory,
                         .field_cap_share = 0.5,
                         .sizes_px = std::move(sizes_px)});
  MappedMemory file = MappedMemory::zeros(layout.bytes());
  uint8_t* const bytes = file.writable().data();
  std::map<int, std::vector<std::string>> made_fields;
  for (int entry = 0; entry < kViewCount; ++entry)
    reinterpret_cast<Eigen::Vector3d*>(bytes + layout.box_rays().offset)[entry] = Eigen::Vector3d::UnitZ();
  for (const auto& [size, sections] : layout.sizes()) {
    const size_t pixels = static_cast<size_t>(size) * size;
    const FieldRows rows(size, memory, kViewCount);
    std::vector<uint8_t> fields(pixels * kColorCount);
    for (int entry = 0; entry < kViewCount; ++entry) {
      LabelImage image(size, size);
      for (int i = 0; i < size; ++i) {
        image(i, entry % size) = static_cast<uint8_t>(1 + entry % kColorCount);
        image(entry / size % size, i) = static_cast<uint8_t>(1 + entry / 7 % kColorCount);
      }
      pack_labels(image, {bytes + sections.labels.offset + entry * packed_bytes(pixels), packed_bytes(pixels)});
      for (int color = 1; color <= kColorCount; ++color)
        chamfer_field(image, static_cast<uint8_t>(color), field_cap(0.5, size),
                      std::span(fields).subspan((color - 1) * pixels, pixels));
      if (sections.fields.bytes > 0)
        std::ranges::copy(fields, bytes + sections.fields.offset + entry * fields.size());
      rows.put(entry, fields.data(), {bytes + sections.rows.offset, sections.rows.bytes});
    }
    made_fields[size] = {"not looked at"};
  }
  layout.seal(file, made_fields);
  return {bytes, bytes + layout.bytes()};
}

/// Where the sections of a good file lie.
inline std::vector<Section> sections_of(const std::string& file) {
  const DatabaseLayout layout({reinterpret_cast<const uint8_t*>(file.data()), file.size()}, "sections_of");
  std::vector<Section> sections = {layout.box_rays()};
  for (const auto& [size, of_size] : layout.sizes())
    for (const Section& section : {of_size.labels, of_size.fields, of_size.rows})
      if (section.bytes > 0) sections.push_back(section);
  return sections;
}

/// The file with right hashes again. `sections`: where they lay before it was damaged.
inline std::string with_right_hashes(std::string file, const std::vector<Section>& sections) {
  constexpr size_t kLength = 22, kHash = 30, kHeader = 62, kHexadecimal = 32;
  for (const Section& section : sections) {
    std::vector<std::string> pieces;
    for (uint64_t begin = 0; begin < section.bytes; begin += section.piece_bytes)
      pieces.push_back(piece_hash(
          {reinterpret_cast<const uint8_t*>(file.data()) + section.offset + begin, section.piece_bytes}));
    const std::string key = section.name() + "\":\"";
    if (const size_t place = file.find(key, kHeader); place < sections.front().offset)
      file.replace(place + key.size(), kHexadecimal, section_hash(pieces));
  }
  uint64_t length = 0;
  std::memcpy(&length, file.data() + kLength, sizeof(length));
  return file.replace(kHash, kHexadecimal, hash_text(std::string_view(file).substr(kHeader, length)));
}

}  // namespace glovebench
