#include "core/base/file_set.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
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
  WholeFiles files(folder, kRunSet);
  for (const std::string& name : names) files.add(name, content + name);
  EXPECT_EQ(files.names(), names);
  files.commit();
}

TEST(WholeFiles, are_in_their_places_with_a_manifest_that_names_them) {
  const TestFolder folder;
  write_set(folder / "set", {"tables/a.csv", "b.json"}, "content of ");
  EXPECT_EQ(read_file(folder / "set/tables/a.csv"), "content of tables/a.csv");
  const auto manifest = read_manifest(folder / "set");
  ASSERT_TRUE(manifest && manifest->files.size() == 2);
  EXPECT_EQ(manifest->files.front().name, "tables/a.csv");
  EXPECT_EQ(manifest->files.front().bytes, 23U);
  EXPECT_EQ(manifest->files.front().hash.size(), 32U);
  EXPECT_FALSE(fs::exists(folder / "set/.staged"));
}

TEST(WholeFiles, without_commit_leave_the_older_set) {
  const TestFolder folder;
  write_set(folder.path(), {"a"}, "old ");
  {
    WholeFiles files(folder.path(), kRunSet);
    files.add("a", "new");
    files.add("b", "new");
  }
  EXPECT_EQ(FileSet(folder.path()).read("a"), "old a");
  EXPECT_EQ(folder.file_count(), 2) << "a and the manifest";
}

TEST(WholeFiles, refuse_names_that_leave_the_folder) {
  const TestFolder folder;
  for (const char* name : {"../evil", "/evil", "x/../../evil", ".staged/a", ".unfinished", ""}) {
    WholeFiles files(folder / "set", kRunSet);
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
  WholeFiles files(folder.path(), kRunSet);
  files.add("a", "new");
  EXPECT_THAT([&] { files.add("link", "x"); }, ThrowsMessage<Error>(HasSubstr("a link")));
  EXPECT_THAT([&] { files.add("folder", "x"); }, ThrowsMessage<Error>(HasSubstr("a folder")));
  files.add("target/below", "x");
  EXPECT_THAT([&] { files.commit(); }, ThrowsMessage<Error>(HasSubstr("target")));
  EXPECT_EQ(FileSet(folder.path()).read("a"), "old a");
}

TEST(WholeFiles, keep_modes_and_files_that_are_kept) {
  const TestFolder folder;
  write_set(folder.path(), {"a", "kept", "other"}, "old ");
  ASSERT_EQ(::chmod((folder / "a").c_str(), 0600), 0);
  WholeFiles files(folder.path(), kRunSet);
  files.add("a", "new");
  files.keep("kept");
  files.keep("missing");
  files.commit();
  EXPECT_EQ(fs::status(folder / "a").permissions(), fs::perms(0600));
  const FileSet set(folder.path());
  EXPECT_EQ(set.read("kept"), "old kept");
  EXPECT_FALSE(set.has("missing") || set.has("other"));
  EXPECT_FALSE(fs::exists(folder / "other"));
}

TEST(WholeFiles, leave_a_file_of_the_older_set_that_was_changed) {
  const TestFolder folder;
  write_set(folder.path(), {"a", "mine", "theirs"}, "old ");
  write_file(folder / "mine", "changed by hand");
  write_set(folder.path(), {"a"}, "new ");
  EXPECT_EQ(read_file(folder / "mine"), "changed by hand");
  EXPECT_FALSE(fs::exists(folder / "theirs"));
}

TEST(WholeFiles, of_two_writers_do_not_mix) {
  const TestFolder folder;
  const auto write = [&](const std::string& content) {
    for (int i = 0; i < 20; ++i) {
      WholeFiles files(folder.path(), kRunSet);
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

TEST(WholeFiles, refuse_a_set_of_another_kind_and_change_nothing) {
  const TestFolder folder;
  write_set(folder.path(), {"a"}, "old ");
  const std::string manifest = read_file(folder / kManifest);
  write_file(folder / ".staged/a", "of an interrupted writer");
  for (const char* kind : {kComparisonSet, kBaselineSet, kRecordingSet, ""}) {
    EXPECT_THAT([&] { WholeFiles(folder.path(), kind); },
                ThrowsMessage<Error>(AllOf(HasSubstr("manifest.json: kind"), HasSubstr("\"run\""))));
    EXPECT_THROW(remove_set(folder.path(), kind), Error);
  }
  EXPECT_EQ(read_file(folder / kManifest), manifest);
  EXPECT_EQ(read_file(folder / "a"), "old a");
  EXPECT_TRUE(fs::exists(folder / ".staged/a"));
}

TEST(WholeFiles, refuse_a_set_that_was_written_before_sets_had_kinds) {
  const TestFolder folder;
  write_file(folder / "a", "old");
  write_file(folder / kManifest, R"({"format": "glovebench-manifest", "version": 1, "files": []})");
  EXPECT_THAT([&] { WholeFiles(folder.path(), kRunSet); }, ThrowsMessage<Error>(HasSubstr("kind")));
  EXPECT_EQ(read_file(folder / "a"), "old");
}

TEST(WholeFiles, refuse_a_manifest_that_is_a_link) {
  const TestFolder folder;
  write_set(folder / "other", {"a"}, "other ");
  const std::string manifest = read_file(folder / "other/manifest.json");
  fs::create_directories(folder / "set");
  fs::create_symlink("../other/manifest.json", folder / "set/manifest.json");
  EXPECT_THAT([&] { WholeFiles(folder / "set", kRunSet); }, ThrowsMessage<Error>(HasSubstr("a link")));
  EXPECT_THAT([&] { remove_set(folder / "set", kRunSet); }, ThrowsMessage<Error>(HasSubstr("a link")));
  EXPECT_EQ(read_file(folder / "other/manifest.json"), manifest);
}

TEST(WholeFiles, refuse_a_damaged_manifest_and_remove_nothing) {
  const TestFolder folder;
  write_set(folder.path(), {"a"}, "old ");
  // As after a kill between the manifest and the moves.
  write_file(folder / ".staged/b", "staged");
  fs::copy(folder / kManifest, folder / ".staged/.older-manifest");
  write_file(folder / kManifest, "{");
  EXPECT_THROW(FileSet(folder.path()), Error);
  EXPECT_THROW(WholeFiles(folder.path(), kRunSet), Error);
  EXPECT_THROW(remove_set(folder.path(), kRunSet), Error);
  EXPECT_EQ(read_file(folder / "a"), "old a");
  EXPECT_EQ(read_file(folder / ".staged/b"), "staged");
  EXPECT_EQ(read_file(folder / kManifest), "{");
}

TEST(WholeFiles, without_a_manifest_remove_nothing_of_an_older_one) {
  const TestFolder folder;
  write_set(folder.path(), {"a"}, "old ");
  fs::create_directories(folder / ".staged");
  fs::rename(folder / kManifest, folder / ".staged/.older-manifest");
  write_set(folder.path(), {"b"}, "new ");
  EXPECT_EQ(read_file(folder / "a"), "old a");
  EXPECT_FALSE(FileSet(folder.path()).has("a"));
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

TEST(FileSet, compares_content_that_was_read_elsewhere) {
  const TestFolder folder;
  write_set(folder.path(), {"a"}, "");
  const FileSet set(folder.path());
  set.expect_content("a", "a");
  set.expect_content("other", "x");
  EXPECT_THAT([&] { set.expect_content("a", "b"); }, ThrowsMessage<BrokenSet>(HasSubstr(folder / "a")));
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
    WholeFiles files(set, kRunSet);
    EXPECT_THAT([&] { files.add("tables/new", "x"); }, is_a_link);
    EXPECT_THAT([&] { files.keep("tables/a"); }, is_a_link);
  }
  EXPECT_THAT([&] { remove_set(set, kRunSet); }, is_a_link);
  EXPECT_TRUE(fs::exists(set + "/b") && fs::exists(set + "/manifest.json"));
  // As after a kill between the manifest and the moves: of the new set, then of the older one.
  write_file(set + "/.staged/tables/a", "tables/a");
  EXPECT_THAT([&] { WholeFiles(set, kRunSet); }, is_a_link);
  fs::copy(set + "/manifest.json", set + "/.staged/.older-manifest");
  write_file(set + "/manifest.json", manifest_json({kRunSet, {}}));
  EXPECT_THAT([&] { WholeFiles(set, kRunSet); }, is_a_link);
  EXPECT_EQ(read_file(elsewhere + "/a"), "tables/a");
  EXPECT_EQ(std::distance(fs::directory_iterator(elsewhere), fs::directory_iterator()), 1);
}

TEST(WholeFiles, refuse_a_staging_folder_that_is_a_link) {
  const TestFolder folder;
  write_set(folder / "set", {"a"}, "old ");
  write_file(folder / "elsewhere/a", "theirs");
  fs::create_symlink("../elsewhere", folder / "set/.staged");
  EXPECT_THROW(WholeFiles(folder / "set", kRunSet), Error);
  EXPECT_EQ(read_file(folder / "elsewhere/a"), "theirs");
}

TEST(FileSet, that_was_interrupted_is_removed_with_what_is_staged) {
  const TestFolder folder;
  write_set(folder.path(), {"a", "b"}, "new ");
  write_file(folder / "only-old", "old");
  fs::create_directories(folder / ".staged");
  fs::rename(folder / "a", folder / ".staged/a");
  write_file(folder / ".staged/.older-manifest", manifest_json({kRunSet, {{"only-old", 3, hash_text("old")}}}));
  write_file(folder / "b", "changed by hand");
  remove_set(folder.path(), kRunSet);
  EXPECT_EQ(folder.file_count(), 1);
  EXPECT_EQ(read_file(folder / "b"), "changed by hand");
}

TEST(FileSet, removed_is_gone_but_for_others_files) {
  const TestFolder folder;
  write_set(folder.path(), {"tables/a", "b"}, "");
  write_file(folder / "notes", "the user's");
  remove_set(folder.path(), kRunSet);
  EXPECT_FALSE(fs::exists(folder / kManifest) || fs::exists(folder / "b") || fs::exists(folder / "tables/a"));
  EXPECT_TRUE(fs::exists(folder / "notes"));
  remove_set(folder / "none", kRunSet);
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
  Manifest manifest{kRecordingSet, {}};
  const std::string hash(4096, '0');  // much longer than they are: fewer images do
  for (int i = 0; i < kImages; ++i) manifest.files.push_back({"d-" + std::to_string(i) + ".pgm", 614'417, hash});
  const std::string text = manifest_json(manifest);
  EXPECT_GT(text.size(), 16U << 20);
  write_file(folder / kManifest, text);
  EXPECT_EQ(manifest_to_replace(folder.path(), kRecordingSet)->files.size(), size_t{kImages});
  EXPECT_NO_THROW(manifest_json(manifest, text.size()));
  EXPECT_THAT([&] { manifest_json(manifest, text.size() - 1); },
              ThrowsMessage<Error>(AllOf(HasSubstr("manifest.json: size"), HasSubstr("at most"))));
}

TEST(Manifest, is_read_as_it_was_written_and_nothing_else) {
  const Manifest manifest = {kBaselineSet, {{"tables/a.csv", 7, std::string(32, '0')}, {"b", 0, "x"}}};
  const auto [kind, read] = parse_manifest(manifest_json(manifest), "manifest.json");
  EXPECT_EQ(kind, "baseline");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].name, "tables/a.csv");
  EXPECT_EQ(read[0].bytes, 7U);
  const auto entry = [](const std::string& file) {
    return R"({"format": "glovebench-manifest", "version": 1, "files": [)" + file + "]}";
  };
  const std::string good = R"({"name": "a", "bytes": 1, "hash": "h"})";
  EXPECT_EQ(parse_manifest(entry(good), "m").files.size(), 1U);
  EXPECT_EQ(parse_manifest(entry(good), "m").kind, "") << "of before there were kinds";
  for (const std::string& bad :
       {std::string("{}"), std::string("[]"), std::string("1"), entry("1"), entry(good + "," + good),
        entry(R"({"name": "../a", "bytes": 1, "hash": "h"})"), entry(R"({"name": "/a", "bytes": 1, "hash": "h"})"),
        entry(R"({"name": "a", "bytes": -1, "hash": "h"})"), entry(R"({"name": "a", "bytes": 1.5, "hash": "h"})"),
        entry(R"({"name": "a", "bytes": 1, "hash": 2})"), entry(R"({"name": "a", "bytes": 1})"),
        entry(R"({"name": "a", "bytes": 1, "hash": "h", "more": 1})"),
        std::string(R"({"format": "another", "version": 1, "files": []})"),
        std::string(R"({"format": "glovebench-manifest", "version": 1, "kind": 1, "files": []})"),
        std::string(R"({"format": "glovebench-manifest", "version": 2, "files": []})")})
    EXPECT_THAT([&] { parse_manifest(bad, "m"); }, ThrowsMessage<Error>(HasSubstr("m"))) << bad;
}

}  // namespace
}  // namespace glovebench
