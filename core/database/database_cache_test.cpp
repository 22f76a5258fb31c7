#include "core/database/database_cache.h"

#include <gmock/gmock.h>
#include <sys/wait.h>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"
#include "render/test_hand.h"

namespace glovebench {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

/// One square of two colors, the same in every view.
class SquareRenderer : public ViewRenderer {
 public:
  LabelImage render_labels(const HandModel&, const PosedHand&, const PinholeCamera& camera,
                           const Eigen::Isometry3d&) override {
    LabelImage image(camera.width, camera.height);
    for (int v = 10; v < 40; ++v)
      for (int u = 10; u < 40; ++u) image(u, v) = static_cast<uint8_t>(1 + u / 20);
    return image;
  }
  HandImages render_ids(const HandModel& model, const PosedHand& hand, const PinholeCamera& camera,
                        const Eigen::Isometry3d& T_camera_hand) override {
    return {render_labels(model, hand, camera, T_camera_hand), {}, {}};
  }
};

class DatabaseCacheTest : public testing::Test {
 protected:
  DatabaseCacheTest() {
    cache_.folder = folder_ / "cache";
    cache_.renderers = [this] {
      ++renderers_made_;
      return std::make_unique<SquareRenderer>();
    };
    cache_.message = [this](const std::string& text) { messages_.push_back(text); };
  }
  Database get() const { return cache_.get(postures_, render::test_hand(), views_, sizes_); }
  /// The one database file in the cache.
  std::string file() const {
    std::string found;
    for (const auto& entry : std::filesystem::directory_iterator(cache_.folder)) {
      if (entry.path().extension() != ".glovedb") continue;
      EXPECT_EQ(found, "") << "more than one";
      found = entry.path();
    }
    return found;
  }
  int database_count() const {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(cache_.folder))
      count += entry.path().extension() == ".glovedb";
    return count;
  }

  const TestFolder folder_;
  int renderers_made_ = 0;
  std::vector<std::string> messages_;
  DatabaseCache cache_;
  PostureSet postures_ = {"DB_cache", {"open"}, {Posture::Zero()}};
  ViewConfig views_ = {.image_size = 64};
  std::vector<int> sizes_ = {8, 16};
};

TEST_F(DatabaseCacheTest, builds_once_and_loads_afterwards) {
  const Database built = get();
  EXPECT_EQ(renderers_made_, 1);
  const std::string hash = hash_file(file());
  const Database loaded = get();
  EXPECT_EQ(renderers_made_, 1);
  EXPECT_EQ(loaded.content_hash(), built.content_hash());
  EXPECT_TRUE(
      std::equal(built.fields(16, 0), built.fields(16, 0) + 756 * 16 * 16 * kColorCount, loaded.fields(16, 0)));
  EXPECT_EQ(hash_file(file()), hash);
  EXPECT_THAT(messages_, IsEmpty());
}

TEST_F(DatabaseCacheTest, names_a_damaged_file_and_rebuilds_it) {
  get();
  const std::string path = file(), good = read_file(path);
  for (const std::string& damaged : {good.substr(0, good.size() / 2), std::string("garbage"), std::string()}) {
    messages_.clear();
    renderers_made_ = 0;
    write_file(path, damaged);
    EXPECT_EQ(get().entry_count(), kViewCount);
    EXPECT_THAT(messages_, ElementsAre(HasSubstr(path)));
    EXPECT_EQ(renderers_made_, 1);
    EXPECT_EQ(hash_file(path), hash_text(good));
  }
}

TEST_F(DatabaseCacheTest, a_file_of_other_inputs_under_this_name_is_rebuilt) {
  get();
  const std::string first = file(), content = read_file(first);
  std::filesystem::remove(first);
  views_.distance = 0.8;
  get();
  const std::string second = file();
  write_file(second, content);  // intact, but of the first inputs
  renderers_made_ = 0;
  get();
  EXPECT_EQ(renderers_made_, 1);
  EXPECT_THAT(messages_, ElementsAre(HasSubstr("other inputs")));
}

TEST_F(DatabaseCacheTest, removes_what_a_killed_build_left) {
  get();
  const std::string left = file() + ".tmp-1-0", other = cache_.folder + "/other.glovedb.tmp-1-0";
  std::filesystem::remove(file());
  write_file(left, "half a database");
  write_file(other, "another's, which may still be in work");
  get();
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_TRUE(std::filesystem::exists(other));
}

TEST_F(DatabaseCacheTest, a_changed_input_makes_another_file) {
  get();
  views_.field_of_view_deg = 25;
  get();
  EXPECT_EQ(database_count(), 2);
  postures_.postures[0][kIndexPipFlexion] = 0.1;
  get();
  EXPECT_EQ(database_count(), 3);
  EXPECT_EQ(renderers_made_, 3);
}

TEST_F(DatabaseCacheTest, other_sources_build_anew_and_leave_no_old_file) {
  cache_.source_hash = "before";
  const std::string content = get().content_hash(), before = file();
  const std::string without = before.substr(0, before.size() - 25) + ".glovedb";  // as it was without a source hash
  write_file(without, "old");
  const std::string low = without.substr(0, without.size() - 8) + "-low-0123456789abcdef.glovedb",
                    other = cache_.folder + "/DB_cache_2-0123456789abcdef-0123456789abcdef.glovedb";
  write_file(low, "of low memory");
  write_file(other, "of other postures");
  cache_.source_hash = "after";
  EXPECT_EQ(get().content_hash(), content);
  EXPECT_EQ(renderers_made_, 2);
  EXPECT_FALSE(std::filesystem::exists(before));
  EXPECT_FALSE(std::filesystem::exists(without));
  EXPECT_TRUE(std::filesystem::exists(low));
  EXPECT_TRUE(std::filesystem::exists(other));
  get();
  EXPECT_EQ(renderers_made_, 2);
  EXPECT_THAT(messages_, IsEmpty());
}

TEST_F(DatabaseCacheTest, another_builder_makes_another_content_of_the_same_inputs) {
  const Database first = get();
  struct Shifted : SquareRenderer {
    LabelImage render_labels(const HandModel& model, const PosedHand& hand, const PinholeCamera& camera,
                             const Eigen::Isometry3d& T_camera_hand) override {
      LabelImage image = SquareRenderer::render_labels(model, hand, camera, T_camera_hand);
      image(20, 20) = image(20, 20) % kColorCount + 1;
      for (int u = 10; u < 40; ++u) image(u, 25) = 9;
      return image;
    }
  };
  cache_.renderers = [] { return std::make_unique<Shifted>(); };
  cache_.source_hash = "of Shifted";
  const Database second = get();
  EXPECT_EQ(second.input_hash(), first.input_hash());
  EXPECT_NE(second.content_hash(), first.content_hash());
}

TEST_F(DatabaseCacheTest, one_of_low_memory_is_another_file) {
  const Database normal = get();
  const std::string content = read_file(file());
  cache_.memory = DatabaseMemory::low;
  const Database low = get();
  EXPECT_EQ(database_count(), 2);
  EXPECT_EQ(low.memory(), DatabaseMemory::low);
  EXPECT_EQ(low.content_hash(), normal.content_hash());
  EXPECT_THAT(messages_, IsEmpty());
  // Under the other's name it is named and rebuilt.
  const std::string path = cache_.path(postures_, render::test_hand(), views_);
  write_file(path, content);
  EXPECT_EQ(get().memory(), DatabaseMemory::low);
  EXPECT_THAT(messages_, ElementsAre(AllOf(HasSubstr(path), HasSubstr("memory: found normal, expected low"))));
}

TEST_F(DatabaseCacheTest, a_folder_that_cannot_be_made_is_an_error) {
  write_file(folder_ / "file", "x");
  cache_.folder = folder_ / "file/cache";
  EXPECT_THAT([&] { get(); }, ThrowsMessage<Error>(HasSubstr(cache_.folder)));
}

TEST_F(DatabaseCacheTest, a_folder_in_the_databases_place_is_an_error_that_names_it) {
  get();
  const std::string path = file();
  std::filesystem::remove(path);
  std::filesystem::create_directories(path + "/inside");
  EXPECT_THAT([&] { get(); }, ThrowsMessage<Error>(HasSubstr(path)));
}

TEST_F(DatabaseCacheTest, two_processes_that_want_the_same_one_build_it_once) {
  // Each child says by its exit code whether it built (1) or loaded (0), and leaves what it got.
  std::vector<pid_t> children;
  for (int c = 0; c < 2; ++c) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      get().save(folder_ / ("got_by_" + std::to_string(c)));
      _exit(messages_.empty() ? renderers_made_ : 9);
    }
    children.push_back(child);
  }
  int built = 0;
  for (const pid_t child : children) {
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    built += WEXITSTATUS(status);
  }
  EXPECT_EQ(built, 1);
  const Database a = Database::load(folder_ / "got_by_0", sizes_), b = Database::load(folder_ / "got_by_1", sizes_);
  EXPECT_EQ(a.content_hash(), b.content_hash());
  for (const int size : sizes_) {
    const size_t bytes = size_t{756} * size * size;
    for (int entry = 0; entry < kViewCount; ++entry) ASSERT_EQ(a.labels(size, entry), b.labels(size, entry));
    EXPECT_TRUE(std::equal(a.fields(size, 0), a.fields(size, 0) + bytes * kColorCount, b.fields(size, 0)));
  }
}

}  // namespace
}  // namespace glovebench
