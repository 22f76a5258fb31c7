#pragma once

#include <cstring>
#include <string>

#include "core/base/hash.h"
#include "core/database/database.h"
#include "core/database/section_check.h"
#include "core/database/tiny_image.h"

namespace glovebench {

inline std::string painted_database(DatabaseMemory memory, std::set<int> sizes_px) {
  DatabaseLayout layout({.postures = {"DB_painted", {"open"}, {Posture::Zero()}},
                         .side = Side::right,
                         .input_hash = "painted",
                         .memory = memory,
                         .field_cap_share = 0.5,
                         .sizes_px = std::move(sizes_px)});
  MappedMemory file = MappedMemory::zeros(layout.bytes());
  uint8_t* const bytes = file.writable().data();
  for (int entry = 0; entry < kViewCount; ++entry)
    reinterpret_cast<Eigen::Vector3d*>(bytes + layout.box_rays().offset)[entry] = Eigen::Vector3d::UnitZ();
  for (const auto& [size, sections] : layout.sizes()) {
    const size_t pixels = static_cast<size_t>(size) * size, fields = pixels * kColorCount;
    for (int entry = 0; entry < kViewCount; ++entry) {
      LabelImage image(size, size);
      for (int i = 0; i < size; ++i) {
        image(i, entry % size) = static_cast<uint8_t>(1 + entry % kColorCount);
        image(entry / size % size, i) = static_cast<uint8_t>(1 + entry / 7 % kColorCount);
      }
      pack_labels(image, {bytes + sections.labels.offset + entry * packed_bytes(pixels), packed_bytes(pixels)});
      if (sections.fields.bytes > 0)
        chamfer_fields(image, field_cap(0.5, size), {bytes + sections.fields.offset + entry * fields, fields});
    }
  }
  layout.seal(file);
  return {bytes, bytes + layout.bytes()};
}

inline DatabaseLayout layout_of(const std::string& file) {
  return DatabaseLayout({reinterpret_cast<const uint8_t*>(file.data()), file.size()}, "layout_of");
}
inline std::vector<Section> stored_sections(const DatabaseLayout& layout) {
  std::vector<Section> sections = layout.sections();
  std::erase_if(sections, [](const Section& section) { return section.bytes == 0; });
  return sections;
}

inline std::string with_right_header(std::string file) {
  constexpr size_t kLength = 22, kHash = 30, kHeader = 62;
  uint64_t length = 0;
  std::memcpy(&length, file.data() + kLength, sizeof(length));
  const std::string hash = hash_text(std::string_view(file).substr(kHeader, length));
  return file.replace(kHash, hash.size(), hash);
}

/// `layout` is that of the undamaged file.
inline std::string with_right_hashes(std::string file, const DatabaseLayout& layout) {
  MappedMemory bytes = MappedMemory::zeros(file.size());
  std::ranges::copy(file, bytes.writable().begin());
  const std::vector<Section> sections = layout.sections();
  const auto contents = look_at_sections(layout, bytes, sections, false).sections;
  for (size_t s = 0; s < sections.size(); ++s) {
    const std::string key = sections[s].name() + "\":\"";
    if (const size_t place = file.find(key); place < layout.box_rays().offset)
      file.replace(place + key.size(), contents[s].hash.size(), contents[s].hash);
  }
  return with_right_header(std::move(file));
}

}  // namespace glovebench
