// What a kill leaves at every moment of a write, and what is on the disk before what. This executable's calls that
// change a file system go through the functions below, which can end the process before the n-th of them, or note
// it.
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <map>

#include "core/base/file_set.h"
#include "core/base/input_file.h"
#include "core/base/line_file.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"

namespace {

constexpr int kKilled = 77;
int calls_to_live = -1;                     ///< negative: no end
std::vector<std::string>* noted = nullptr;  ///< calls in their order

void note(const std::string& call) {
  if (calls_to_live == 0) _exit(kKilled);
  if (calls_to_live > 0) --calls_to_live;
  if (noted != nullptr) noted->push_back(call);
}

std::string path_of(int descriptor) {
  std::error_code ignored;
  return std::filesystem::read_symlink(fmt::format("/proc/self/fd/{}", descriptor), ignored).string();
}

}  // namespace

extern "C" {
int fsync(int descriptor) {
  note("sync " + path_of(descriptor));
  return static_cast<int>(syscall(SYS_fsync, descriptor));
}
int rename(const char* from, const char* to) noexcept {
  note(fmt::format("rename to {}", to));
  return static_cast<int>(syscall(SYS_renameat, AT_FDCWD, from, AT_FDCWD, to));
}
int mkdir(const char* path, mode_t mode) noexcept {
  note(fmt::format("make {}", path));
  return static_cast<int>(syscall(SYS_mkdirat, AT_FDCWD, path, mode));
}
int unlinkat(int folder, const char* path, int flags) noexcept {
  note(fmt::format("remove {}", path));
  return static_cast<int>(syscall(SYS_unlinkat, folder, path, flags));
}
int remove(const char* path) noexcept {
  const int failed = unlinkat(AT_FDCWD, path, 0);
  return failed != 0 && errno == EISDIR ? unlinkat(AT_FDCWD, path, AT_REMOVEDIR) : failed;
}
ssize_t write(int descriptor, const void* bytes, size_t count) {
  if (calls_to_live >= 0) note("write");
  return syscall(SYS_write, descriptor, bytes, count);
}
}

namespace glovebench {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::ElementsAre;

using Files = std::map<std::string, std::string>;

/// Writes these files; what else the manifest names goes.
void write_set(const std::string& folder, const Files& files) {
  WholeFiles set(folder);
  for (const auto& [name, unused] : Manifest(set.manifest()))
    if (!files.contains(name)) set.remove(name);
  for (const auto& [name, content] : files) set.add(name, content);
  set.commit();
}

/// What a reader gets of these names.
Files read_set(const std::string& folder, const Files& names) {
  const FileSet set(folder);
  Files files;
  for (const auto& [name, unused] : names)
    if (set.has(name)) files[name] = set.read(name);
  return files;
}

/// Runs a write that ends before the n-th call. Returns whether it came to its end instead.
bool survives(int calls, const std::function<void()>& write) {
  const pid_t child = fork();
  if (child == 0) {
    calls_to_live = calls;
    write();
    calls_to_live = -1;
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && (WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == kKilled)) << status;
  return WEXITSTATUS(status) == 0;
}

const Files kOld = {{"results.json", "old"}, {"tables/a.csv", "old a"}, {"estimates/only-old.csv", "old only"}};
const Files kNew = {{"results.json", "new results"}, {"tables/a.csv", "new a"}, {"tables/b.csv", "new b"}};
const Files kNext = {{"results.json", "next"}, {"summary.md", "next summary"}};
const Files kAllNames = [] {
  Files all = kOld;
  all.insert(kNew.begin(), kNew.end());
  return all;
}();

TEST(FileSet, is_all_old_or_all_new_whenever_its_writer_is_killed) {
  int old_sets = 0, new_sets = 0;
  for (int calls = 0;; ++calls) {
    const TestFolder folder;
    const std::string set = folder / "set";
    write_set(set, kOld);
    write_file(set + "/notes.txt", "the user's");
    const bool survived = survives(calls, [&] { write_set(set, kNew); });
    const Files found = read_set(set, kAllNames);
    ASSERT_THAT(found, AnyOf(kOld, kNew)) << "killed before call " << calls;
    ++(found == kNew ? new_sets : old_sets);
    EXPECT_TRUE(found == kNew || new_sets == 0) << "never back again";

    write_set(set, kNext);  // whatever the kill left
    EXPECT_EQ(read_set(set, kAllNames), (Files{{"results.json", "next"}}));
    Files all;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(set))
      if (entry.is_regular_file()) all[fs::relative(entry.path(), set)] = read_file(entry.path());
    all.erase(kManifest);
    Files expected = kNext;
    expected["notes.txt"] = "the user's";
    EXPECT_EQ(all, expected) << "killed before call " << calls;
    if (survived) break;
  }
  EXPECT_GT(old_sets, 10);
  EXPECT_GT(new_sets, 5);
}

TEST(FileSet, of_before_manifests_stays_until_the_new_one_is_whole) {
  for (int calls = 0;; ++calls) {
    const TestFolder folder;
    for (const auto& [name, content] : kOld) write_file(folder / name, content);
    const bool survived = survives(calls, [&] { write_set(folder.path(), kNew); });
    Files expected = kOld;
    if (fs::exists(folder / kManifest)) expected = kNew;
    ASSERT_EQ(read_set(folder.path(), kAllNames), expected) << "killed before call " << calls;
    if (survived) break;
  }
}

TEST(WholeFile, is_old_or_new_whenever_its_writer_is_killed) {
  const TestFolder folder;
  const std::string path = folder / "file";
  write_file(path, "old");
  int calls = 0;
  while (!survives(calls, [&] { write_file(path, "new"); }) && calls < 100) {
    EXPECT_THAT(read_file(path), AnyOf("old", "new")) << calls;
    ++calls;
  }
  EXPECT_GE(calls, 3);
  EXPECT_EQ(read_file(path), "new");
}

/// The calls of a write.
std::vector<std::string> calls_of(const std::function<void()>& write) {
  std::vector<std::string> calls;
  noted = &calls;
  write();
  noted = nullptr;
  return calls;
}

TEST(WholeFile, is_synced_with_all_folders_that_lead_to_it) {
  const TestFolder folder;
  const std::vector<std::string> calls = calls_of([&] { write_file(folder / "a/b/file", "content"); });
  EXPECT_THAT(calls, ElementsAre("make " + folder / "a", "make " + folder / "a/b", "sync " + folder / "a",
                                 "sync " + folder.path(), testing::StartsWith("sync " + folder / "a/b/file.tmp-"),
                                 "rename to " + folder / "a/b/file", "sync " + folder / "a/b"));
}

TEST(LineFile, is_synced_with_its_folder) {
  const TestFolder folder;
  LineFile file(folder / "lines");
  file.append("line");
  EXPECT_THAT(
      calls_of([&] { file.finish(); }),
      ElementsAre("sync " + folder / "lines.partial", "rename to " + folder / "lines", "sync " + folder.path()));
}

TEST(FileSet, is_on_the_disk_before_its_manifest_and_in_place_before_the_staging_folder_goes) {
  const TestFolder folder;
  const std::vector<std::string> calls = calls_of([&] { write_set(folder.path(), kNew); });
  const auto at = [&](const std::string& call) {
    return std::ranges::find_if(calls, [&](const std::string& c) { return c.starts_with(call); }) - calls.begin();
  };
  const auto manifest = at("rename to " + folder / kManifest);
  ASSERT_LT(manifest, std::ssize(calls));
  for (const char* staged : {"/results.json", "/tables/a.csv", "/tables/b.csv", "/tables"})
    EXPECT_LT(at("sync " + folder / ".staged" + staged), manifest) << staged;
  EXPECT_EQ(calls[manifest + 1], "sync " + folder.path());
  const auto placed = at("rename to " + folder / "tables/b.csv"), gone = at("remove ");
  EXPECT_LT(manifest, placed);
  const auto synced = std::find(calls.begin() + placed, calls.end(), "sync " + folder / "tables") - calls.begin();
  EXPECT_LT(synced, gone);
  EXPECT_LT(gone, std::ssize(calls));
}

}  // namespace
}  // namespace glovebench
