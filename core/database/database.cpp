#include "core/database/database.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/whole_file.h"
#include "core/database/tiny_image.h"

namespace glovebench {
uint8_t field_cap(double cap_share, int size) {
  return static_cast<uint8_t>(std::clamp(std::lround(cap_share * size * kFieldScale), 1l, 255l));
}

void Database::save(const std::string& path) const {
  const std::span<const uint8_t> bytes = bytes_->bytes();
  write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Database Database::load(const std::string& path, std::span<const int> sizes) {
  const auto bytes = std::make_shared<const MappedMemory>(MappedMemory::of_file(path));
  const DatabaseLayout layout(bytes->bytes(), path);
  return Database(bytes, layout, layout.read_sections(*bytes, path, sizes));
}

Database::Database(std::shared_ptr<const MappedMemory> bytes, const DatabaseLayout& layout,
                   std::map<int, FieldRows> rows)
    : bytes_(std::move(bytes)),
      header_(layout.header()),
      content_hash_(layout.content_hash()),
      rows_(std::make_shared<const std::map<int, FieldRows>>(std::move(rows))) {
  const uint8_t* const file = bytes_->bytes().data();
  box_rays_ = reinterpret_cast<const Eigen::Vector3d*>(file + layout.box_rays().offset);
  for (const auto& [size, rows_of_size] : *rows_) {
    const auto& [labels, fields] = layout.sizes().at(size);
    if (memory() == DatabaseMemory::low) bytes_->expect_random_reads(labels.offset, labels.bytes);
    sizes_[size] = {file + labels.offset, fields.bytes > 0 ? file + fields.offset : nullptr, &rows_of_size};
  }
}

void Database::check() const {
  if (memory() == DatabaseMemory::low) return;  // its fields are made of its labels
  for (const auto& [size, data] : sizes_) {
    tbb::parallel_for(0, entry_count(), [&, size = size](int entry) {
      const LabelImage image = labels(size, entry);
      std::vector<uint8_t> made(image.size() * kColorCount);
      chamfer_fields(image, field_cap(size), made);
      if (!std::ranges::equal(made, std::span(fields(size, entry), made.size())))
        throw Error("database " + header_.postures.name, fmt::format("fields_{}, entry {}", size, entry),
                    "other distances", "those of its labels");
    });
  }
}

const Database::SizeData& Database::data(int size) const {
  const auto it = sizes_.find(size);
  if (it == sizes_.end()) {
    throw Error("database " + header_.postures.name, "tiny images", fmt::format("no {} px", size),
                "a size that was loaded");
  }
  return it->second;
}

LabelImage Database::labels(int size, int entry) const {
  const size_t bytes = packed_bytes(static_cast<size_t>(size) * size);
  return unpack_labels({data(size).labels + entry * bytes, bytes}, size, size);
}

const uint8_t* Database::fields(int size, int entry) const {
  const uint8_t* const fields = data(size).fields;
  if (fields == nullptr)
    throw Error("database " + header_.postures.name, "fields", "a low-memory database", "one that stores them");
  return fields + static_cast<size_t>(entry) * size * size * kColorCount;
}

}  // namespace glovebench
