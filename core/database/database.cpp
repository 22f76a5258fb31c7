#include "core/database/database.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/whole_file.h"
#include "core/database/packed_labels.h"

namespace glovebench {
namespace {

/// A section, in memory that large pages make up. What was copied of a low-memory database's file does not stay
/// resident twice.
std::shared_ptr<MappedMemory> copy_of(const MappedMemory& file, const Section& section, DatabaseMemory memory) {
  auto copy = std::make_shared<MappedMemory>(MappedMemory::zeros(section.bytes));
  constexpr size_t kPiece = 4 << 20;
  tbb::parallel_for(size_t{0}, (section.bytes + kPiece - 1) / kPiece, [&](size_t piece) {
    const size_t begin = piece * kPiece, bytes = std::min(kPiece, section.bytes - begin);
    std::ranges::copy(file.bytes().subspan(section.offset + begin, bytes),
                      copy->writable().begin() + static_cast<ptrdiff_t>(begin));
    if (memory == DatabaseMemory::low) file.release(section.offset + begin, bytes);
  });
  return copy;
}

}  // namespace

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
  layout.check_sections(*bytes, path, sizes);
  return Database(bytes, layout, sizes);
}

Database::Database(std::shared_ptr<const MappedMemory> bytes, const DatabaseLayout& layout,
                   std::span<const int> sizes)
    : bytes_(std::move(bytes)), header_(layout.header()), content_hash_(layout.content_hash()) {
  const uint8_t* const file = bytes_->bytes().data();
  box_rays_ = reinterpret_cast<const Eigen::Vector3d*>(file + layout.box_rays().offset);
  for (const auto& [size, sections] : layout.sizes()) {
    if (std::ranges::find(sizes, size) == sizes.end()) continue;
    const auto rows = copy_of(*bytes_, sections.rows, memory());
    FieldRows(size, memory(), entry_count()).repeat_last_entry(rows->writable());
    if (memory() == DatabaseMemory::low) bytes_->expect_random_reads(sections.labels.offset, sections.labels.bytes);
    sizes_[size] = {file + sections.labels.offset,
                    sections.fields.bytes > 0 ? file + sections.fields.offset : nullptr, rows,
                    FieldRows(size, memory(), entry_count(), rows->bytes())};
  }
}

void Database::check() const {
  for (const auto& [size, data] : sizes_) {
    tbb::parallel_for(size_t{0}, data.rows.block_count(),
                      [&, size = size](size_t block) { check_block(size, static_cast<int>(block)); });
  }
}

void Database::check_block(int size, int block) const {
  const int first = block * FieldRows::kBlock, count = std::min(FieldRows::kBlock, entry_count() - first);
  const FieldRows shape(size, memory(), count);
  std::vector<uint8_t> fields(static_cast<size_t>(size) * size * kColorCount), rows(shape.block_bytes());
  const auto fail = [&](const std::string& field, int entry) {
    throw Error("database " + header_.postures.name, fmt::format("{}_{}, entry {}", field, size, entry),
                "other distances", "those of its labels");
  };
  for (int entry = first; entry < first + count; ++entry) {
    const LabelImage image = labels(size, entry);
    for (int color = 1; color <= kColorCount; ++color)
      chamfer_field(image, static_cast<uint8_t>(color), field_cap(size),
                    std::span(fields).subspan((color - 1) * image.size(), image.size()));
    if (memory() == DatabaseMemory::normal &&
        !std::ranges::equal(fields, std::span(this->fields(size, entry), fields.size())))
      fail("fields", entry);
    shape.put(entry - first, fields.data(), rows);
  }
  shape.repeat_last_entry(rows);
  const auto [made, stored] =
      std::ranges::mismatch(rows, std::span(data(size).rows.data() + block * rows.size(), rows.size()));
  if (made != rows.end()) fail("rows", first + static_cast<int>((made - rows.begin()) % FieldRows::kBlock));
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
  if (fields == nullptr) {
    throw Error("database " + header_.postures.name, "fields", "a low-memory database", "one that stores them");
  }
  return fields + static_cast<size_t>(entry) * size * size * kColorCount;
}

}  // namespace glovebench
