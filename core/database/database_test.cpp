#include "core/database/database.h"

#include <gmock/gmock.h>

#include <optional>
#include <set>

#include "ci/build_paths.h"
#include "core/base/error.h"
#include "core/base/sanitizers.h"
#include "core/base/whole_file.h"
#include "core/database/test_block_database.h"
#include "core/database/test_database.h"

namespace glovebench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

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
    for (const int size : kTinySizes)
      EXPECT_EQ(entry_image(database, size, entry), make_tiny_image(image, square, size)) << entry;
    EXPECT_NEAR((database.box_ray(entry) - square_ray(square, camera)).norm(), 0, 1e-12) << entry;
  }
}

TEST(Database, no_view_of_the_hand_is_cut_off) {
  // The whole hand is in every view: nothing of it touches the image border.
  render::LabelRenderer renderer;
  const double f = 96 / std::tan(0.5 * 24 * M_PI / 180);
  const PinholeCamera camera{192, 192, f, f, 95.5, 95.5};
  const PosedHand hand = render::test_hand().pose(Posture::Zero());
  for (int view = 0; view < kViewCount; view += kHasAddressSanitizer ? 15 : 5) {
    Eigen::Isometry3d T_view_hand = Eigen::Isometry3d::Identity();
    T_view_hand.linear() = view_rotations()[view];
    T_view_hand.translation().z() = 0.75;
    const LabelImage image = renderer.render_labels(render::test_hand(), hand, camera, T_view_hand);
    for (int i = 0; i < 192; ++i)
      ASSERT_EQ(image(i, 0) + image(i, 191) + image(0, i) + image(191, i), 0) << "view " << view;
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
  EXPECT_EQ(loaded.input_hash(), normal.input_hash());
  EXPECT_EQ(loaded.content_hash(), normal.content_hash());
  for (const int size : kTinySizes) {
    EXPECT_EQ(loaded.field_cap(size), normal.field_cap(size));
    for (int entry = 0; entry < normal.entry_count(); ++entry)
      ASSERT_EQ(loaded.labels(size, entry), normal.labels(size, entry)) << size << " px, entry " << entry;
    EXPECT_THAT([&] { loaded.fields(size, 0); },
                ThrowsMessage<Error>(AllOf(HasSubstr("DB_one"), HasSubstr("fields"), HasSubstr("low-memory"))));
  }
  EXPECT_LT(std::filesystem::file_size(folder / "low") * 16, std::filesystem::file_size(folder / "normal"));
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
  const Database database =
      Database::build(one_posture(), render::test_hand(), kSmallViews, make_block_renderer, 1, {}, kSizes);
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
    Database::build(one_posture(), render::test_hand(), kSmallViews, make_block_renderer, 1, {}, sizes);
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
  hashes.insert(Database::input_hash(set, HandModel::load(build_paths::hand_mesh(), Side::left), {}));
  for (const ViewConfig& views : {ViewConfig{.distance = 0.76}, ViewConfig{.field_of_view_deg = 25},
                                  ViewConfig{.image_size = 193}, ViewConfig{.field_cap_share = 0.51}})
    hashes.insert(Database::input_hash(set, model, views));
  EXPECT_EQ(hashes.size(), 10u);
}

TEST(Database, no_postures_is_an_error) {
  EXPECT_THAT(
      [] {
        Database::build({"DB_none", {}, {}}, render::test_hand(), kSmallViews, make_block_renderer, 1);
      },
      ThrowsMessage<Error>(HasSubstr("DB_none")));
}

}  // namespace
}  // namespace glovebench
