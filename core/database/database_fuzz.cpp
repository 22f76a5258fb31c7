#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>

#include "core/base/fuzz_target.h"
#include "core/database/look_up.h"
#include "core/database/test_damaged_database.h"

namespace glovebench {
namespace {

constexpr std::array kSizes = {8, 26};

/// A file of the memory alone: a database is mapped from its file.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("database", MFD_CLOEXEC)) {
    check(descriptor_ >= 0, "a file in memory");
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  void write(const std::string& bytes) const {
    check(::ftruncate(descriptor_, 0) == 0, "the file can be emptied");
    check(::write(descriptor_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()), "room for it");
    check(::lseek(descriptor_, 0, SEEK_SET) == 0, "the file can be written again");
  }
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

struct Painted {
  std::string file;
  DatabaseLayout layout;
  std::vector<Section> sections;  ///< that the file holds
};

const Painted& painted(DatabaseMemory memory) {
  const auto make = [](DatabaseMemory which) {
    const std::string file = painted_database(which, {kSizes.begin(), kSizes.end()});
    const DatabaseLayout layout = layout_of(file);
    return Painted{file, layout, stored_sections(layout)};
  };
  static const Painted normal = make(DatabaseMemory::normal), low = make(DatabaseMemory::low);
  return memory == DatabaseMemory::low ? low : normal;
}

/// Seven bytes: where (a section; the last number: the header), the place in it, how often, and the byte to write.
constexpr size_t kEdit = 7;

void edit(Painted& damaged, const uint8_t* data) {
  const size_t number = data[0] % (damaged.sections.size() + 1), count = 1 + data[5];
  const uint32_t place = data[1] | data[2] << 8 | data[3] << 16 | static_cast<uint32_t>(data[4]) << 24;
  const bool is_header = number == damaged.sections.size();
  const uint64_t begin = is_header ? 0 : damaged.sections[number].offset;
  const uint64_t length = is_header ? damaged.sections[0].offset : damaged.sections[number].bytes;
  for (size_t i = 0; i < count; ++i) damaged.file[begin + (place + i) % length] = static_cast<char>(data[6]);
}

LabelImage query_of(int size, const uint8_t* data, size_t bytes) {
  LabelImage image(size, size);
  for (size_t i = 0; i < image.size(); ++i)
    image[i] = static_cast<uint8_t>((i / 5 + (bytes > 0 ? data[i % bytes] : 0)) % (kColorCount + 1));
  return image;
}

/// All look-ups give the same entries, which exist.
void look_up_all(const Database& database, const uint8_t* data, size_t bytes) {
  for (const Cascade& cascade :
       {Cascade{{26, 3}}, Cascade{{8, 3}}, Cascade{{8, 100}, {26, 3}}, Cascade{{8, 9}, {26, 2}}}) {
    TinyImages query;
    for (const CascadeStage& stage : cascade) query.images.push_back(query_of(stage.size, data, bytes));
    const auto plain = look_up(database, query, cascade, "plain");
    for (const Match& match : plain) {
      check(match.entry >= 0 && match.entry < database.entry_count(), "an entry that exists");
      check(match.error >= 0 && match.error <= 26, "a distance within the image");
      check(database.box_ray(match.entry).allFinite(), "a direction");
    }
    for (const LookUpEntry& other : look_ups()) {
      const auto found = look_up(database, query, cascade, other.name);
      check(std::ranges::equal(
                found, plain,
                [](const Match& a, const Match& b) { return a.entry == b.entry && a.error == b.error; }),
            "the plain look-up's matches");
    }
  }
}

}  // namespace

// The first byte says what the database holds; then come edits of its file, whose hashes are made right again: no
// mutation finds one.
void database_fuzz(std::string_view bytes) {
  const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
  const size_t size = bytes.size();
  static const MemoryFile file;
  Painted damaged = painted(size > 0 && data[0] % 2 == 1 ? DatabaseMemory::low : DatabaseMemory::normal);
  for (size_t i = 1; i + kEdit <= size; i += kEdit) edit(damaged, data + i);
  file.write(with_right_hashes(std::move(damaged.file), damaged.layout));
  expect_value_or_error([&] { look_up_all(Database::load(file.path(), kSizes), data, size); });
}

}  // namespace glovebench
