#include "core/database/database.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstring>
#include <optional>
#include <set>
#include <sstream>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/base/hash.h"
#include "core/base/random.h"
#include "core/database/test_database.h"

namespace glovebench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Paints colored blocks that follow from the view alone: quick, for tests of everything but the pictures.
class BlockRenderer : public ViewRenderer {
 public:
  LabelImage render_labels(const HandModel&, const PosedHand&, const PinholeCamera& camera,
                           const Eigen::Isometry3d& T_camera_hand) override {
    LabelImage image(camera.width, camera.height);
    const Eigen::Vector3d axis = T_camera_hand.linear().col(0);
    const int left = static_cast<int>(20 + 15 * axis.x()), top = static_cast<int>(20 + 15 * axis.y());
    for (int v = top; v < top + 24; ++v) {
      for (int u = left; u < left + 18; ++u) {
        image(u, v) = static_cast<uint8_t>(1 + (u / 6 + v / 6 + static_cast<int>(4 + 4 * axis.z())) % kColorCount);
      }
    }
    return image;
  }
};

constexpr ViewConfig kSmallViews{.image_size = 64};

PostureSet one_posture() {
  return {"DB_one", {"open"}, {Posture::Zero()}};
}

Database small_database(DatabaseMemory memory = DatabaseMemory::normal) {
  return Database::build(
      one_posture(), render::test_hand(), kSmallViews, [] { return std::make_unique<BlockRenderer>(); }, 1, {},
      kTinySizes, memory);
}

void expect_equal(const Database& a, const Database& b, std::span<const int> sizes = kTinySizes) {
  EXPECT_EQ(a.hash(), b.hash());
  EXPECT_EQ(a.side(), b.side());
  EXPECT_EQ(a.posture_set().name, b.posture_set().name);
  EXPECT_EQ(a.posture_set().posture_names, b.posture_set().posture_names);
  EXPECT_EQ(a.posture_set().postures, b.posture_set().postures);
  EXPECT_EQ(a.memory(), b.memory());
  ASSERT_EQ(a.entry_count(), b.entry_count());
  for (int entry = 0; entry < a.entry_count(); ++entry) {
    ASSERT_EQ(a.box_ray(entry), b.box_ray(entry)) << "entry " << entry;
    for (const int size : sizes) {
      const size_t pixels = static_cast<size_t>(size) * size;
      ASSERT_EQ(a.labels(size, entry), b.labels(size, entry)) << size << " px, entry " << entry;
      ASSERT_EQ(a.field_cap(size), b.field_cap(size));
      if (a.memory() == DatabaseMemory::low) continue;
      ASSERT_TRUE(
          std::equal(a.fields(size, entry), a.fields(size, entry) + pixels * kColorCount, b.fields(size, entry)))
          << size << " px, entry " << entry;
    }
  }
}

TEST(Database, does_not_depend_on_the_number_of_threads) {
  const PostureSet postures = one_posture();
  const ViewConfig views{.image_size = 96};
  const auto build = [&](int threads) {
    return Database::build(postures, render::test_hand(), views, render::label_renderer_factory(), threads);
  };
  expect_equal(build(1), build(2));
}

TEST(Database, holds_the_view_of_each_entry) {
  const Database& database = test_database();
  ASSERT_EQ(database.entry_count(), 2 * 756);
  render::LabelRenderer renderer;
  const double f = 96 / std::tan(0.5 * 24 * M_PI / 180);  // 192 px see 24 degrees
  const PinholeCamera camera{192, 192, f, f, 95.5, 95.5};
  for (const int entry : {0, 17, 400, 755, 756, 1200, 1511}) {
    Eigen::Isometry3d T_view_hand = Eigen::Isometry3d::Identity();
    T_view_hand.linear() = view_rotations()[entry % 756];
    T_view_hand.translation().z() = 0.75;
    const PosedHand hand = render::test_hand().pose(entry < 756 ? Posture(Posture::Zero()) : power_posture());
    const LabelImage image = renderer.render_labels(render::test_hand(), hand, camera, T_view_hand);
    const Square square = bounding_square(image);
    for (const int size : kTinySizes) {
      EXPECT_EQ(entry_image(database, size, entry), make_tiny_image(image, square, size)) << entry;
    }
    EXPECT_NEAR((database.box_ray(entry) - square_ray(square, camera)).norm(), 0, 1e-12) << entry;
  }
}

TEST(Database, no_view_of_the_hand_is_cut_off) {
  // The whole hand is in every view: nothing of it touches the image border.
  render::LabelRenderer renderer;
  const double f = 96 / std::tan(0.5 * 24 * M_PI / 180);
  const PinholeCamera camera{192, 192, f, f, 95.5, 95.5};
  const PosedHand hand = render::test_hand().pose(Posture::Zero());
  for (int view = 0; view < kViewCount; view += 5) {
    Eigen::Isometry3d T_view_hand = Eigen::Isometry3d::Identity();
    T_view_hand.linear() = view_rotations()[view];
    T_view_hand.translation().z() = 0.75;
    const LabelImage image = renderer.render_labels(render::test_hand(), hand, camera, T_view_hand);
    for (int i = 0; i < 192; ++i) {
      ASSERT_EQ(image(i, 0) + image(i, 191) + image(0, i) + image(191, i), 0) << "view " << view;
    }
  }
}

TEST(Database, comes_back_from_its_file) {
  const TestFolder folder;
  const Database database = small_database();
  database.save(folder / "db");
  expect_equal(Database::load(folder / "db"), database);
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(Database, a_copy_outlives_its_original_and_the_file_its_name) {
  const TestFolder folder;
  std::optional<Database> loaded;
  {
    small_database().save(folder / "db");
    loaded = Database::load(folder / "db");
  }
  write_file(folder / "db", "another");
  const Database copy = *loaded, small = small_database();
  loaded.reset();
  expect_equal(copy, small);
  for (const int size : kTinySizes) {
    const FieldRows &a = copy.field_rows(size), &b = small.field_rows(size);
    EXPECT_TRUE(std::equal(a.data(), a.data() + a.block_count() * a.block_bytes(), b.data())) << size;
  }
}

TEST(Database, of_low_memory_holds_the_same_labels_and_no_fields) {
  const TestFolder folder;
  const Database normal = small_database(), low = small_database(DatabaseMemory::low);
  low.save(folder / "low");
  normal.save(folder / "normal");
  const Database loaded = Database::load(folder / "low");
  expect_equal(loaded, low);
  EXPECT_EQ(loaded.memory(), DatabaseMemory::low);
  EXPECT_EQ(loaded.hash(), normal.hash());
  for (const int size : kTinySizes) {
    EXPECT_EQ(loaded.field_cap(size), normal.field_cap(size));
    for (int entry = 0; entry < normal.entry_count(); ++entry)
      ASSERT_EQ(loaded.labels(size, entry), normal.labels(size, entry)) << size << " px, entry " << entry;
    EXPECT_THAT([&] { loaded.fields(size, 0); },
                ThrowsMessage<Error>(AllOf(HasSubstr("DB_one"), HasSubstr("fields"), HasSubstr("low-memory"))));
  }
  EXPECT_LT(std::filesystem::file_size(folder / "low") * 8, std::filesystem::file_size(folder / "normal"));
}

TEST(Database, loads_only_the_sizes_asked_for) {
  const TestFolder folder;
  const Database database = small_database();
  database.save(folder / "db");
  const std::array<int, 2> wanted = {16, 64};
  const Database loaded = Database::load(folder / "db", wanted);
  expect_equal(loaded, database, wanted);
  EXPECT_FALSE(loaded.has_size(8));
  EXPECT_THAT([&] { loaded.fields(8, 0); }, ThrowsMessage<Error>(AllOf(HasSubstr("DB_one"), HasSubstr("8 px"))));
}

TEST(Database, has_tiny_images_of_any_size_asked_for) {
  constexpr std::array<int, 5> kSizes = {48, 4, 8, 23, 64};
  const auto renderers = [] { return std::make_unique<BlockRenderer>(); };
  const Database database =
      Database::build(one_posture(), render::test_hand(), kSmallViews, renderers, 1, {}, kSizes);
  EXPECT_FALSE(database.has_size(16));
  for (const int size : kSizes) {
    const auto cap = static_cast<uint8_t>(std::lround(kSmallViews.field_cap_share * size * kFieldScale));
    const size_t pixels = static_cast<size_t>(size) * size;
    for (const int entry : {0, 300, 755}) {
      const LabelImage image = entry_image(database, size, entry);
      for (int color = 1; color <= kColorCount; ++color) {
        std::vector<uint8_t> field(pixels);
        chamfer_field_plain(image, static_cast<uint8_t>(color), cap, field);
        const uint8_t* const stored = database.fields(size, entry) + (color - 1) * pixels;
        ASSERT_TRUE(std::equal(field.begin(), field.end(), stored)) << size << " px, entry " << entry;
      }
    }
  }
  // The other sizes change nothing.
  constexpr std::array<int, 2> kShared = {8, 64};
  expect_equal(database, small_database(), kShared);
}

TEST(Database, impossible_sizes_are_errors) {
  const auto build = [](std::vector<int> sizes) {
    const auto renderers = [] { return std::make_unique<BlockRenderer>(); };
    Database::build(one_posture(), render::test_hand(), kSmallViews, renderers, 1, {}, sizes);
  };
  EXPECT_THAT([&] { build({8, 3}); }, ThrowsMessage<Error>(AllOf(HasSubstr("DB_one"), HasSubstr("3 px"))));
  EXPECT_THAT([&] { build({65}); }, ThrowsMessage<Error>(HasSubstr("4 to 64 px")));
  EXPECT_THAT([&] { build({8, 16, 8}); }, ThrowsMessage<Error>(HasSubstr("8 px twice")));
  EXPECT_THAT([&] { build({}); }, ThrowsMessage<Error>(HasSubstr("no sizes")));
}

TEST(Database, the_input_hash_knows_every_input) {
  const PostureSet set = one_posture();
  const HandModel& model = render::test_hand();
  std::set<std::string> hashes = {Database::input_hash(set, model, {})};
  PostureSet other = set;
  other.name = "DB_two";
  hashes.insert(Database::input_hash(other, model, {}));
  other = set;
  other.posture_names[0] = "flat";
  hashes.insert(Database::input_hash(other, model, {}));
  other = set;
  other.postures[0][kLittleDipFlexion] += 1e-15;
  hashes.insert(Database::input_hash(other, model, {}));
  hashes.insert(Database::input_hash(test_postures(), model, {}));
  hashes.insert(Database::input_hash(set, HandModel::load(GLOVEBENCH_HAND_MESH, Side::left), {}));
  for (const ViewConfig& views : {ViewConfig{.distance = 0.76}, ViewConfig{.field_of_view_deg = 25},
                                  ViewConfig{.image_size = 193}, ViewConfig{.field_cap_share = 0.51}}) {
    hashes.insert(Database::input_hash(set, model, views));
  }
  EXPECT_EQ(hashes.size(), 10u);
}

TEST(Database, no_postures_is_an_error) {
  EXPECT_THAT(
      [] {
        Database::build(
            {"DB_none", {}, {}}, render::test_hand(), kSmallViews, [] { return std::make_unique<BlockRenderer>(); },
            1);
      },
      ThrowsMessage<Error>(HasSubstr("DB_none")));
}

/// A good file's content, and what `load` says about another content under the same name.
class DatabaseFile : public testing::Test {
 protected:
  DatabaseFile() {
    small_database().save(path_);
    good_ = read_file(path_);
  }
  void expect_refused(const std::string& content, const std::string& what) {
    write_file(path_, content);
    try {
      Database::load(path_);
      ADD_FAILURE() << what << ": loaded";
    } catch (const Error& e) {
      EXPECT_THAT(e.what(), AllOf(HasSubstr(path_ + ": "), HasSubstr("expected "))) << what;
    }
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
  std::string newer = good_;
  newer[newer.find("-3\n") + 1] = '4';
  write_file(path_, newer);
  EXPECT_THAT([&] { Database::load(path_); },
              ThrowsMessage<Error>(AllOf(HasSubstr("magic"), HasSubstr("glovebench-database-3"))));
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
                                 {"\"checksums\":[", "\"checksums\":[\"\","},
                                 {"\"postures\":[", "\"postures\":[{},"},
                                 {"\"postures\":[", "\"postures\":3,\"p\":["},
                                 {"\"name\":", "\"nome\":"},
                                 {"{", "["}})
    expect_refused(with_header(good_, from, to), to);
}

TEST_F(DatabaseFile, of_a_memory_that_nobody_knows_is_an_error_that_says_what_is_known) {
  write_file(path_, with_header(good_, "\"memory\":\"normal\"", "\"memory\":\"tiny\""));
  EXPECT_THAT([&] { Database::load(path_); },
              ThrowsMessage<Error>(AllOf(HasSubstr(path_ + ": memory: found \"tiny\""),
                                         HasSubstr("expected \"normal\" or \"low\""))));
}

TEST_F(DatabaseFile, of_low_memory_that_is_damaged_anywhere_is_an_error) {
  small_database(DatabaseMemory::low).save(path_);
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
  damaged[good_.size() - 4200] ^= 1;  // the last section: the rows of the largest images
  write_file(path_, damaged);
  const std::array<int, 2> wanted = {8, 16};
  expect_equal(Database::load(path_, wanted), small_database(), wanted);
  EXPECT_THAT([&] { Database::load(path_); }, ThrowsMessage<Error>(HasSubstr("rows_64 checksum")));
}

TEST_F(DatabaseFile, is_the_same_whether_it_was_built_in_memory_or_not) {
  const auto renderers = [] { return std::make_unique<BlockRenderer>(); };
  const std::string built = folder_ / "built.glovedb";
  for (const DatabaseMemory memory : {DatabaseMemory::normal, DatabaseMemory::low}) {
    Database::build_file(built, one_posture(), render::test_hand(), kSmallViews, renderers, 2, {}, kTinySizes,
                         memory);
    small_database(memory).save(path_);
    EXPECT_TRUE(read_file(built) == read_file(path_)) << to_string(memory);
  }
}

/// What this process has in memory, bytes: of files, and its own unless the address sanitizer is there, which keeps
/// what was freed.
int64_t resident_bytes() {
  std::istringstream numbers(read_file("/proc/self/statm"));
  int64_t whole = 0, resident = 0, of_files = 0;
  numbers >> whole >> resident >> of_files;
#ifdef __SANITIZE_ADDRESS__
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
  Database::build_file(
      built, postures, render::test_hand(), kSmallViews, [] { return std::make_unique<BlockRenderer>(); }, 2,
      progress, std::array{16});
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
