#include "core/base/file_set.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>

#include "core/base/hash.h"
#include "core/base/input_file.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

void write_set(const std::string& folder, const std::vector<std::string>& names, const std::string& content) {
  WholeFiles files(folder);
  for (const std::string& name : names) files.add(name, content + name);
  EXPECT_EQ(files.names(), names);
  files.commit();
}

TEST(WholeFiles, of_a_write_without_its_manifest_remove_nothing) {
  const TestFolder folder;
  const std::string set = folder / "set";
  write_set(set, {"a"}, "content of ");
  write_file(set + "/mine.csv", "by hand");
  // A kill after the list of what is removed, before the manifest that goes with it.
  write_file(set + "/.staged/.removed", hash_text("another manifest") + "\nmine.csv\n");
  write_set(set, {"b"}, "content of ");
  EXPECT_EQ(read_file(set + "/mine.csv"), "by hand");
  EXPECT_FALSE(std::filesystem::exists(set + "/.staged"));
}

TEST(FileSet, without_a_manifest_does_not_mix_with_one_that_is_written_meanwhile) {
  const TestFolder folder;
  const std::string set = folder / "set";
  write_file(set + "/a", "old");
  const FileSet before(set);
  EXPECT_EQ(before.read("a"), "old");
  write_set(set, {"a"}, "content of ");
  EXPECT_THROW(before.read("a"), BrokenSet);
  EXPECT_EQ(FileSet(set).read("a"), "content of a");
}

TEST(WholeFiles, are_in_their_places_with_a_manifest_that_names_them) {
  const TestFolder folder;
  write_set(folder / "set", {"tables/a.csv", "b.json"}, "content of ");
  EXPECT_EQ(read_file(folder / "set/tables/a.csv"), "content of tables/a.csv");
  const auto manifest = read_manifest(folder / "set");
  ASSERT_TRUE(manifest && manifest->size() == 2);
  EXPECT_EQ(manifest->at("tables/a.csv").bytes, 23U);
  EXPECT_EQ(manifest->at("tables/a.csv").hash.size(), 32U);
  EXPECT_FALSE(fs::exists(folder / "set/.staged"));
}

TEST(WholeFiles, without_commit_leave_the_older_set) {
  const TestFolder folder;
  write_set(folder.path(), {"a"}, "old ");
  {
    WholeFiles files(folder.path());
    files.add("a", "new");
    files.add("b", "new");
  }
  EXPECT_EQ(FileSet(folder.path()).read("a"), "old a");
  EXPECT_EQ(folder.file_count(), 2) << "a and the manifest";
}

TEST(WholeFiles, refuse_names_that_leave_the_folder) {
  const TestFolder folder;
  for (const char* name : {"../evil", "/evil", "x/../../evil", ".staged/a", ".unfinished", ""}) {
    WholeFiles files(folder / "set");
    EXPECT_THAT([&] { files.add(name, "x"); }, ThrowsMessage<Error>(HasSubstr("stays in the folder"))) << name;
  }
  EXPECT_EQ(folder.file_count(), 1);
  EXPECT_TRUE(fs::is_empty(folder / "set"));
}

TEST(WholeFiles, refuse_what_they_would_destroy_before_they_write) {
  const TestFolder folder;
  write_set(folder.path(), {"a"}, "old ");
  write_file(folder / "target", "the user's");
  fs::create_symlink("target", folder / "link");
  fs::create_directories(folder / "folder");
  WholeFiles files(folder.path());
  files.add("a", "new");
  EXPECT_THAT([&] { files.add("link", "x"); }, ThrowsMessage<Error>(HasSubstr("a link")));
  EXPECT_THAT([&] { files.add("folder", "x"); }, ThrowsMessage<Error>(HasSubstr("a folder")));
  files.add("target/below", "x");
  EXPECT_THAT([&] { files.commit(); }, ThrowsMessage<Error>(HasSubstr("target")));
  EXPECT_EQ(FileSet(folder.path()).read("a"), "old a");
}

TEST(WholeFiles, replace_and_remove_what_they_name_and_nothing_else) {
  const TestFolder folder;
  write_set(folder.path(), {"a", "other", "gone"}, "old ");
  write_file(folder / "loose", "the user's");
  ASSERT_EQ(::chmod((folder / "a").c_str(), 0600), 0);
  WholeFiles files(folder.path());
  EXPECT_TRUE(files.manifest().contains("other"));
  files.add("a", "new a");
  files.add("b", "new b");
  for (const char* name : {"gone", "loose", "missing"}) files.remove(name);
  EXPECT_EQ(read_file(folder / "loose"), "the user's") << "until commit";
  files.commit();
  const FileSet set(folder.path());
  EXPECT_EQ(set.read("a"), "new a");
  EXPECT_EQ(set.read("b"), "new b");
  EXPECT_EQ(set.read("other"), "old other") << "of the older set";
  EXPECT_FALSE(set.has("gone"));
  EXPECT_EQ(folder.file_count(), 4) << "a, b, other and the manifest";
  EXPECT_EQ(fs::status(folder / "a").permissions(), fs::perms(0600));
}

TEST(WholeFiles, that_are_private_have_a_private_manifest) {
  const TestFolder folder;
  WholeFiles files(folder.path());
  files.add("key", "secret", 0600);
  files.add("certificate", "for all");
  files.commit();
  EXPECT_EQ(fs::status(folder / "key").permissions(), fs::perms(0600));
  EXPECT_EQ(fs::status(folder / kManifest).permissions(), fs::perms(0600));
  EXPECT_NE(fs::status(folder / "certificate").permissions(), fs::perms(0600));
}

TEST(WholeFiles, take_the_place_of_no_manifest) {
  const TestFolder folder;
  EXPECT_THAT([&] { WholeFiles(folder.path()).add(kManifest, "x"); }, ThrowsMessage<Error>(HasSubstr(kManifest)));
}

TEST(WholeFiles, replace_a_set_of_an_older_version_with_a_kind) {
  const TestFolder folder;
  write_set(folder.path(), {"a"}, "old ");
  std::string manifest = read_file(folder / kManifest);
  manifest.insert(manifest.find(" \"files\""), " \"kind\": \"run\",\n");
  write_file(folder / kManifest, manifest);
  EXPECT_EQ(FileSet(folder.path()).read("a"), "old a");
  write_set(folder.path(), {"b"}, "new ");
  EXPECT_EQ(FileSet(folder.path()).read("a"), "old a");
  EXPECT_THAT(read_file(folder / kManifest), testing::Not(HasSubstr("kind")));
}

TEST(WholeFiles, of_two_writers_do_not_mix) {
  const TestFolder folder;
  const auto write = [&](const std::string& content) {
    for (int i = 0; i < 20; ++i) {
      WholeFiles files(folder.path());
      for (const char* name : {"a", "b", "c"}) files.add(name, content);
      files.commit();
    }
  };
  std::thread one(write, "one"), two(write, "two");
  one.join();
  two.join();
  const FileSet set(folder.path());
  EXPECT_TRUE(set.read("a") == set.read("b") && set.read("b") == set.read("c"));
  EXPECT_EQ(folder.file_count(), 4);
}

TEST(WholeFiles, refuse_a_manifest_that_is_a_link) {
  const TestFolder folder;
  write_set(folder / "other", {"a"}, "other ");
  const std::string manifest = read_file(folder / "other/manifest.json");
  fs::create_directories(folder / "set");
  fs::create_symlink("../other/manifest.json", folder / "set/manifest.json");
  EXPECT_THAT([&] { WholeFiles{folder / "set"}; }, ThrowsMessage<Error>(HasSubstr("a link")));
  EXPECT_EQ(read_file(folder / "other/manifest.json"), manifest);
}

TEST(WholeFiles, refuse_a_damaged_manifest_and_remove_nothing) {
  const TestFolder folder;
  write_set(folder.path(), {"a"}, "old ");
  // As after a kill between the manifest and the moves.
  write_file(folder / ".staged/b", "staged");
  write_file(folder / ".staged/.removed", "a\n");
  write_file(folder / kManifest, "{");
  EXPECT_THROW(FileSet(folder.path()), Error);
  EXPECT_THROW(WholeFiles{folder.path()}, Error);
  EXPECT_EQ(read_file(folder / "a"), "old a");
  EXPECT_EQ(read_file(folder / ".staged/b"), "staged");
  EXPECT_EQ(read_file(folder / kManifest), "{");
}

TEST(WholeFiles, without_a_manifest_finish_no_write) {
  const TestFolder folder;
  write_file(folder / "a", "by hand");
  write_file(folder / ".staged/b", "staged");
  write_file(folder / ".staged/.removed", "a\n");
  write_set(folder.path(), {"c"}, "new ");
  EXPECT_EQ(read_file(folder / "a"), "by hand");
  EXPECT_FALSE(fs::exists(folder / "b"));
}

TEST(FileSet, takes_only_what_the_manifest_names_and_as_it_says) {
  const TestFolder folder;
  write_set(folder.path(), {"a", "b", "c"}, "");
  write_file(folder / "b", "d");  // as long
  write_file(folder / "other", "x");
  fs::remove(folder / "c");
  const FileSet set(folder.path());
  EXPECT_EQ(set.read("a"), "a");
  for (const char* name : {"b", "c"})
    EXPECT_THAT([&] { set.read(name); },
                ThrowsMessage<BrokenSet>(AllOf(HasSubstr(folder / name), HasSubstr("as manifest.json says"))));
  EXPECT_FALSE(set.has("other"));
  EXPECT_THAT([&] { set.read("other"); }, ThrowsMessage<BrokenSet>(HasSubstr("none that manifest.json names")));
  EXPECT_THAT([&] { set.read("a", 0); }, ThrowsMessage<Error>(HasSubstr("more than 0 bytes")));
}

TEST(FileSet, finds_what_was_changed_or_added_by_hand_and_says_so) {
  const TestFolder folder;
  write_set(folder.path(), {"a", "b", "c"}, "");
  fs::create_directories(folder / ".staged");
  fs::rename(folder / "a", folder / ".staged/a");  // as after a kill
  write_file(folder / "b", "changed");
  write_file(folder / "other", "added");
  fs::remove(folder / "c");
  const FileSet set(folder.path());
  const auto find = [&](const std::string& name) {
    const FileSet::Found found = set.find(name, 100);
    return std::pair(found.content, found.is_changed);
  };
  EXPECT_EQ(find("a"), std::pair(std::string("a"), false));
  EXPECT_EQ(find("b"), std::pair(std::string("changed"), true));
  EXPECT_EQ(find("other"), std::pair(std::string("added"), false));
  EXPECT_THROW(find("c"), Error);
  EXPECT_THAT([&] { set.refuse("b"); }, ThrowsMessage<BrokenSet>(HasSubstr(folder / "b")));
}

TEST(FileSet, without_a_manifest_is_read_as_it_is) {
  const TestFolder folder;
  write_file(folder / "a", "by hand");
  const FileSet set(folder.path());
  EXPECT_EQ(set.read("a"), "by hand");
  EXPECT_FALSE(set.has("b"));
  EXPECT_THROW(set.read("b"), Error);
}

TEST(FileSet, that_is_replaced_while_it_is_read_does_not_mix) {
  const TestFolder folder;
  write_set(folder.path(), {"a", "b"}, "old ");
  const FileSet set(folder.path());
  EXPECT_EQ(set.read("a"), "old a");
  write_set(folder.path(), {"a", "b"}, "new ");
  EXPECT_THROW(set.read("b"), BrokenSet);
}

TEST(WholeFiles, follow_no_link_out_of_the_folder) {
  const TestFolder folder;
  const std::string set = folder / "set", elsewhere = folder / "elsewhere";
  write_set(set, {"tables/a", "b"}, "");
  fs::rename(set + "/tables", elsewhere);
  fs::create_symlink(elsewhere, set + "/tables");
  const auto is_a_link = ThrowsMessage<Error>(AllOf(HasSubstr(set + "/tables"), HasSubstr("a link")));
  {
    WholeFiles files(set);
    EXPECT_THAT([&] { files.add("tables/new", "x"); }, is_a_link);
    EXPECT_THAT([&] { files.remove("tables/a"); }, is_a_link);
  }
  // As after a kill between the manifest and the moves: of a new file, then of one that is removed.
  write_file(set + "/.staged/tables/a", "tables/a");
  EXPECT_THAT([&] { WholeFiles{set}; }, is_a_link);
  write_file(set + "/.staged/.removed", hash_text(manifest_json({})) + "\ntables/a\n");
  write_file(set + "/manifest.json", manifest_json({}));
  EXPECT_THAT([&] { WholeFiles{set}; }, is_a_link);
  EXPECT_EQ(read_file(elsewhere + "/a"), "tables/a");
  EXPECT_EQ(std::distance(fs::directory_iterator(elsewhere), fs::directory_iterator()), 1);
}

TEST(WholeFiles, refuse_a_staging_folder_that_is_a_link) {
  const TestFolder folder;
  write_set(folder / "set", {"a"}, "old ");
  write_file(folder / "elsewhere/a", "theirs");
  fs::create_symlink("../elsewhere", folder / "set/.staged");
  EXPECT_THROW(WholeFiles{folder / "set"}, Error);
  EXPECT_EQ(read_file(folder / "elsewhere/a"), "theirs");
}

TEST(WholeFiles, finish_a_write_that_was_interrupted) {
  const TestFolder folder;
  write_set(folder.path(), {"a", "b"}, "new ");
  write_file(folder / "only-old", "old");
  fs::create_directories(folder / ".staged");
  fs::rename(folder / "a", folder / ".staged/a");
  write_file(folder / ".staged/.removed", hash_file(folder / kManifest) + "\nonly-old\nb\n");
  { const WholeFiles next(folder.path()); }
  EXPECT_EQ(read_file(folder / "a"), "new a");
  EXPECT_FALSE(fs::exists(folder / "only-old"));
  EXPECT_EQ(read_file(folder / "b"), "new b") << "the manifest names it: it was written since";
  EXPECT_EQ(folder.file_count(), 3);
}

TEST(WholeFiles, wait_for_a_short_write_of_another_process) {
  const TestFolder folder;
  auto held = std::make_unique<FolderLock>(folder.path());
  const std::jthread other([&held] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    held.reset();
  });
  write_set(folder.path(), {"a"}, "");
  EXPECT_TRUE(fs::exists(folder / "a"));
}

TEST(WholeFilesLong, do_not_wait_for_a_long_write_of_another_process) {
  const TestFolder folder;
  const FolderLock held(folder.path());
  EXPECT_THAT([&] { WholeFiles{folder.path()}; },
              ThrowsMessage<Error>(HasSubstr("that another process has written")));
}

TEST(FileSet, refuses_a_pipe_instead_of_waiting_for_its_writer) {
  const TestFolder folder;
  const auto is_a_pipe = ThrowsMessage<Error>(HasSubstr("found a pipe"));
  ASSERT_EQ(mkfifo((folder / "a").c_str(), 0600), 0);
  EXPECT_THAT([&] { FileSet(folder.path()).read("a"); }, is_a_pipe);
  fs::remove(folder / "a");
  write_set(folder.path(), {"a"}, "");
  fs::remove(folder / "a");
  ASSERT_EQ(mkfifo((folder / "a").c_str(), 0600), 0);
  EXPECT_THROW(FileSet(folder.path()).read("a"), BrokenSet);
  fs::remove(folder / kManifest);
  ASSERT_EQ(mkfifo((folder / kManifest).c_str(), 0600), 0);
  EXPECT_THAT([&] { FileSet{folder.path()}; }, is_a_pipe);
}

TEST(Manifest, of_a_long_recording_can_be_written_and_read) {
  const TestFolder folder;
  constexpr int kImages = 5000;
  Manifest manifest;
  const std::string hash(4096, '0');  // much longer than they are: fewer images do
  for (int i = 0; i < kImages; ++i) manifest["d-" + std::to_string(i) + ".pgm"] = {614'417, hash};
  const std::string text = manifest_json(manifest);
  EXPECT_GT(text.size(), 16U << 20);
  write_file(folder / kManifest, text);
  EXPECT_EQ(read_manifest(folder.path())->size(), size_t{kImages});
  EXPECT_NO_THROW(manifest_json(manifest, text.size()));
  EXPECT_THAT([&] { manifest_json(manifest, text.size() - 1); },
              ThrowsMessage<Error>(AllOf(HasSubstr("manifest.json: size"), HasSubstr("at most"))));
}

TEST(Manifest, is_read_as_it_was_written_and_nothing_else) {
  const Manifest manifest = {{"tables/a.csv", {7, std::string(32, '0')}}, {"b", {0, "x"}}};
  const Manifest read = parse_manifest(manifest_json(manifest), "manifest.json");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read.at("tables/a.csv").bytes, 7U);
  EXPECT_EQ(read.at("b").hash, "x");
  const auto entry = [](const std::string& file) {
    return R"({"format": "glovebench-manifest", "version": 1, "files": [)" + file + "]}";
  };
  const std::string good = R"({"name": "a", "bytes": 1, "hash": "h"})";
  EXPECT_EQ(parse_manifest(entry(good), "m").size(), 1U);
  for (const std::string& bad :
       {std::string("{}"), std::string("[]"), std::string("1"), entry("1"), entry(good + "," + good),
        entry(R"({"name": "../a", "bytes": 1, "hash": "h"})"), entry(R"({"name": "/a", "bytes": 1, "hash": "h"})"),
        entry(R"({"name": "a", "bytes": -1, "hash": "h"})"), entry(R"({"name": "a", "bytes": 1.5, "hash": "h"})"),
        entry(R"({"name": "a", "bytes": 1, "hash": 2})"), entry(R"({"name": "a", "bytes": 1})"),
        entry(R"({"name": "a", "bytes": 1, "hash": "h", "more": 1})"),
        std::string(R"({"format": "another", "version": 1, "files": []})"),
        std::string(R"({"format": "glovebench-manifest", "files": []})")})
    EXPECT_THAT([&] { parse_manifest(bad, "m"); }, ThrowsMessage<Error>(HasSubstr("m"))) << bad;
  EXPECT_THAT([] { parse_manifest(R"({"format": "glovebench-manifest", "version": 2, "files": []})", "m"); },
              ThrowsMessage<Error>(HasSubstr("m: version: found 2, expected")));
}

}  // namespace
}  // namespace glovebench
