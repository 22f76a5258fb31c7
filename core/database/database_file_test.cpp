#include "core/database/database_file.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <sstream>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/input_file.h"
#include "core/base/random.h"
#include "core/base/sanitizers.h"
#include "core/base/whole_file.h"
#include "core/database/look_up.h"
#include "core/database/test_block_database.h"
#include "core/test_error.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Every kind of section, in a file of few megabytes: fields whose rows are of pixels and of cells.
constexpr std::array kFewSizes = {8, 16, 32};

/// A good file's content, and what `load` says about another content under the same name.
class DatabaseFile : public testing::Test {
 protected:
  DatabaseFile() {
    small_database(DatabaseMemory::normal, kFewSizes).save(path_);
    good_ = read_file(path_);
  }
  void expect_refused(const std::string& content, const std::string& what) {
    write_file(path_, content);
    EXPECT_THAT(thrown_by([&] { Database::load(path_); }), AllOf(HasSubstr(path_ + ": "), HasSubstr("expected ")))
        << what;
  }

  const TestFolder folder_;
  const std::string path_ = folder_ / "damaged.glovedb";
  std::string good_;
};

TEST_F(DatabaseFile, truncated_anywhere_is_an_error) {
  std::vector<size_t> lengths = {0, 1, 21, 22, 23, 29, 30, 31, 61, 62, 63, 100, good_.size() - 1};
  RandomStream random(1, "database file", 0, "lengths");
  for (int i = 0; i < 20; ++i) lengths.push_back(random.index(good_.size()));
  for (const size_t length : lengths) expect_refused(good_.substr(0, length), std::to_string(length) + " bytes");
}

TEST_F(DatabaseFile, changed_in_place_is_looked_up_no_more) {
  write_file(path_, good_);
  const Database database = Database::load(path_, kFewSizes);
  const Cascade cascade = {{8, 3}};
  TinyImages query;
  query.images.push_back(database.labels(8, 0));
  EXPECT_NO_THROW(look_up(database, query, cascade));
  std::filesystem::resize_file(path_, 4096);
  EXPECT_THAT([&] { look_up(database, query, cascade); },
              ThrowsMessage<Error>(AllOf(HasSubstr(path_), HasSubstr("changed while it was in use"))));
}

TEST_F(DatabaseFile, a_flipped_bit_anywhere_is_an_error) {
  std::vector<size_t> places = {good_.size() - 1};
  for (size_t i = 0; i < 70; ++i) places.push_back(i);  // magic, length, checksum, the header's begin
  RandomStream random(1, "database file", 0, "places");
  for (int i = 0; i < 20; ++i) places.push_back(random.index(good_.size()));
  for (const size_t place : places) {
    std::string flipped = good_;
    flipped[place] = static_cast<char>(flipped[place] ^ (1 << random.index(8)));
    expect_refused(flipped, "byte " + std::to_string(place));
  }
}

TEST_F(DatabaseFile, another_format_and_trailing_bytes_are_errors_that_say_so) {
  expect_refused(good_ + '\0', "one byte more");
  expect_refused("PNG\n" + good_, "something in front");
  std::string older = good_;
  older[older.find("-5\n") + 1] = '4';
  write_file(path_, older);
  EXPECT_THAT([&] { Database::load(path_); },
              ThrowsMessage<Error>(AllOf(HasSubstr("magic: found a database of another version"),
                                         HasSubstr("glovebench-database-5 (glovebench db build makes one)"))));
}

/// The file with another header of the same length, whose checksum is right.
std::string with_header(std::string file, const std::string& from, const std::string& to) {
  constexpr size_t kLength = 22, kHash = 30, kHeader = 62;
  uint64_t length = 0;
  std::memcpy(&length, file.data() + kLength, sizeof(length));
  std::string header = file.substr(kHeader, length);
  header.replace(header.find(from), from.size(), to);
  header.resize(length, ' ');
  return file.replace(kHash, 32, hash_text(header)).replace(kHeader, length, header);
}

TEST_F(DatabaseFile, a_header_that_nobody_wrote_is_an_error) {
  const std::string sizes = "\"sizes_px\":[8,16,";
  for (const auto& [from, to] : {std::pair{sizes, std::string("\"sizes_px\":[8,96,")},
                                 {sizes, "\"sizes_px\":[8,-1,"},
                                 {sizes, "\"sizes_px\":[8,17,"},
                                 {sizes, "\"sizes_px\":[8,{},"},
                                 {sizes, "\"sizes_px\":[8,16.5,"},
                                 {sizes, "\"sizes_px\":[8,4294967312,"},
                                 {sizes, "\"sizes_px\":[8,16,16,"},
                                 {sizes, "\"sizes_px\":[16,8,"},
                                 {"\"right\"", "\"Right\""},
                                 {"\"memory\":\"normal\"", "\"memory\":\"low\""},
                                 {"\"memory\":\"normal\"", "\"memory\":1"},
                                 {"\"field_cap_share\":0.5", "\"field_cap_share\":0.0"},
                                 {"\"field_cap_share\":0.5", "\"field_cap_share\":1.5"},
                                 {"\"field_cap_share\":0.5", "\"field_cap_share\":null"},
                                 {"\"side\":", "\"more\":1,\"side\":"},
                                 {"\"angles_rad\":[0.0,", "\"angles_rad\":["},
                                 {"\"angles_rad\":[", "\"angles_rad\":[{},"},
                                 {"\"hashes\":{", "\"hashes\":{\"fields_9\":\"\","},
                                 {"\"hashes\":{", "\"hashes\":[],\"h\":{"},
                                 {"\"labels_8\":", "\"labels_9\":"},
                                 {"\"postures\":[", "\"postures\":[{},"},
                                 {"\"postures\":[", "\"postures\":3,\"p\":["},
                                 {"\"name\":", "\"nome\":"},
                                 {"{", "["}})
    expect_refused(with_header(good_, from, to), to);
}

TEST_F(DatabaseFile, of_a_memory_that_nobody_knows_is_an_error_that_says_what_is_known) {
  write_file(path_, with_header(good_, "\"memory\":\"normal\"", "\"memory\":\"tiny\""));
  EXPECT_THAT([&] { Database::load(path_); },
              ThrowsMessage<Error>(
                  AllOf(HasSubstr(path_ + ": memory: found \"tiny\""), HasSubstr("expected normal or low"))));
}

TEST_F(DatabaseFile, of_a_side_that_nobody_knows_is_an_error_that_says_what_is_known) {
  write_file(path_, with_header(good_, "\"side\":\"right\"", "\"side\":\"north\""));
  EXPECT_THAT([&] { Database::load(path_); },
              ThrowsMessage<Error>(
                  AllOf(HasSubstr(path_ + ": side: found \"north\""), HasSubstr("expected right or left"))));
}

TEST_F(DatabaseFile, of_low_memory_that_is_damaged_anywhere_is_an_error) {
  small_database(DatabaseMemory::low, kFewSizes).save(path_);
  const std::string good = read_file(path_);
  RandomStream random(1, "low-memory file", 0, "places");
  for (int i = 0; i < 20; ++i) {
    const size_t place = random.index(good.size());
    std::string flipped = good;
    flipped[place] = static_cast<char>(flipped[place] ^ (1 << random.index(8)));
    expect_refused(flipped, "byte " + std::to_string(place));
    expect_refused(good.substr(0, place), std::to_string(place) + " bytes");
  }
}

TEST_F(DatabaseFile, damage_in_a_size_that_is_not_wanted_is_not_looked_for) {
  std::string damaged = good_;
  damaged[good_.size() - 4200] ^= 1;  // the last section: the fields of the largest images
  write_file(path_, damaged);
  const std::array<int, 2> wanted = {8, 16};
  expect_equal(Database::load(path_, wanted), small_database(DatabaseMemory::normal, kFewSizes), wanted);
  EXPECT_THAT([&] { Database::load(path_); }, ThrowsMessage<Error>(HasSubstr("fields_32 checksum")));
}

TEST_F(DatabaseFile, is_the_same_whether_it_was_built_in_memory_or_not) {
  const std::string built = folder_ / "built.glovedb";
  for (const DatabaseMemory memory : {DatabaseMemory::normal, DatabaseMemory::low}) {
    Database::build_file(built, one_posture(), render::test_hand(), kSmallViews, make_block_renderer, 2, {},
                         kFewSizes, memory);
    small_database(memory, kFewSizes).save(path_);
    EXPECT_TRUE(read_file(built) == read_file(path_)) << to_string(memory);
  }
}

/// What this process has in memory, bytes: of files, and its own unless the address sanitizer is there, which keeps
/// what was freed.
int64_t resident_bytes() {
  std::istringstream numbers(read_file("/proc/self/statm"));
  int64_t whole = 0, resident = 0, of_files = 0;
  numbers >> whole >> resident >> of_files;
#ifdef GLOVEBENCH_ADDRESS_SANITIZER
  resident = of_files;
#endif
  return resident * sysconf(_SC_PAGESIZE);
}

TEST_F(DatabaseFile, of_any_length_is_written_in_little_memory) {
  PostureSet postures{"DB_many", {}, {}};
  for (int p = 0; p < 24; ++p) {
    postures.posture_names.push_back(std::to_string(p));
    postures.postures.push_back(Posture::Constant(0.01 * p));
  }
  int64_t start = 0, most = 0;
  const auto progress = [&](double) {
    if (start == 0) start = resident_bytes();  // the threads have what they need
    most = std::max(most, resident_bytes());
  };
  const std::string built = folder_ / "built.glovedb";
  Database::build_file(built, postures, render::test_hand(), kSmallViews, make_block_renderer, 2, progress,
                       std::array{24});
  const auto file_bytes = static_cast<int64_t>(std::filesystem::file_size(built));
  EXPECT_GT(file_bytes, 80 << 20);
  EXPECT_LT(most - start, file_bytes / 4);
}

TEST_F(DatabaseFile, a_missing_file_and_a_folder_are_errors) {
  EXPECT_THAT([&] { Database::load(folder_ / "none"); }, ThrowsMessage<Error>(HasSubstr(folder_ / "none")));
  EXPECT_THAT([&] { Database::load(folder_.path()); }, ThrowsMessage<Error>(HasSubstr(folder_.path())));
}

}  // namespace
}  // namespace glovebench
