#include "bench/scale/repeated_database.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/base/file.h"
#include "core/database/database.h"

namespace glovebench::bench {
namespace {

/// A file and where its parts lie.
struct Content {
  MappedMemory& memory;
  const DatabaseLayout& layout;

  int entry_count() const { return static_cast<int>(layout.header().postures.postures.size()) * kViewCount; }
};

DatabaseHeader repeated(const DatabaseHeader& header, int times) {
  DatabaseHeader result = header;
  result.postures.name += fmt::format("_times_{}", times);
  result.hash = "of no inputs";
  for (int i = 1; i < times; ++i) {
    for (size_t p = 0; p < header.postures.postures.size(); ++p) {
      result.postures.postures.push_back(header.postures.postures[p]);
      result.postures.posture_names.push_back(fmt::format("{}_{}", header.postures.posture_names[p], i + 1));
    }
  }
  return result;
}

void repeat(const Content& from, const Section& source, int times, const Content& to, const Section& target) {
  for (int i = 0; i < times; ++i) {
    std::ranges::copy(from.memory.bytes().subspan(source.offset, source.bytes),
                      to.memory.writable().begin() + static_cast<ptrdiff_t>(target.offset + i * source.bytes));
    from.memory.release(source.offset, source.bytes);
    to.memory.release(target.offset, target.bytes);
  }
}

/// Rows hold blocks of entries, which need not end where the postures do.
void repeat_rows(const Content& from, const Section& source, const Content& to, const Section& target, int size) {
  constexpr size_t kBlock = FieldRows::kBlock;
  const DatabaseMemory memory = from.layout.header().memory;
  const size_t count = from.entry_count(), last = to.entry_count() - 1;
  const FieldRows shape(size, memory, to.entry_count());
  tbb::parallel_for(size_t{0}, shape.block_count(), [&](size_t block) {
    uint8_t* const rows = to.memory.writable().data() + target.offset + block * shape.block_bytes();
    for (size_t e = 0; e < kBlock; ++e) {
      const size_t entry = std::min(block * kBlock + e, last) % count;
      const uint8_t* const values =
          from.memory.bytes().data() + source.offset + entry / kBlock * shape.block_bytes();
      for (size_t row = 0; row < shape.row_count(); ++row)
        rows[row * kBlock + e] = values[row * kBlock + entry % kBlock];
    }
    if (block % 4096 == 0) to.memory.release(target.offset, target.bytes);
  });
}

}  // namespace

void repeat_database(const std::string& path, int times, const std::string& repeated_path) {
  MappedMemory source = MappedMemory::of_file(path);
  const DatabaseLayout layout(source.bytes(), path), repeated_layout(repeated(layout.header(), times));
  WholeFile file(repeated_path);
  MappedMemory target = file.map(repeated_layout.bytes());
  const Content from{source, layout}, to{target, repeated_layout};
  repeat(from, layout.box_rays(), times, to, repeated_layout.box_rays());
  for (const auto& [size, sections] : layout.sizes()) {
    const SizeSections& repeated_sections = repeated_layout.sizes().at(size);
    repeat(from, sections.labels, times, to, repeated_sections.labels);
    if (sections.fields.bytes > 0) repeat(from, sections.fields, times, to, repeated_sections.fields);
    repeat_rows(from, sections.rows, to, repeated_sections.rows, size);
  }
  repeated_layout.seal(target);
  file.commit();
}

}  // namespace glovebench::bench
