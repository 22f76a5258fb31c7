#include "eval/run_store.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/input_file.h"
#include "core/base/text.h"
#include "core/base/whole_file.h"
#include "eval/terminal.h"
#include "reports/results.h"

namespace glovebench::eval {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kLargestContent = uint64_t{256} << 20;  // bytes: a million frames
constexpr const char* kMark = "/.unfinished";
constexpr const char* kDone = ".finished-";  // prefix of a mark that is being removed

/// True if the path still leads to the open file.
bool is_still_there(int descriptor, const std::string& path) {
  struct stat opened {
  }, present{};
  return ::fstat(descriptor, &opened) == 0 && ::stat(path.c_str(), &present) == 0 &&
         opened.st_ino == present.st_ino && opened.st_dev == present.st_dev;
}

/// Removes marks that were put aside before a kill.
void remove_done_marks(const std::string& folder) {
  std::vector<fs::path> done;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().filename().string().starts_with(kDone)) done.push_back(entry.path());
  for (const fs::path& path : done) fs::remove_all(path, ignored);
}

const std::string& program_hash() {
  static const std::string hash = hash_file("/proc/self/exe");
  return hash;
}

/// The first line of a stored file.
std::string heading(const std::string& key, std::string_view content) {
  return fmt::format("glovebench-stored {} {} {}\n", program_hash(), key, hash_text(content));
}

std::string path_of(const std::string& mark, const std::string& key) { return path_within(mark, key + ".stored"); }

}  // namespace

RunStore::RunStore(const std::string& folder) : folder_(folder), mark_(folder + kMark) {
  lock();
  remove_done_marks(folder_);
}

/// A finishing run removes the lock file with its mark. A lock on such a file is useless, so another is taken.
void RunStore::lock() {
  const std::string path = mark_ + "/lock";
  while (lock_ < 0) {
    std::error_code error;
    make_folders(folder_);
    keep_mark_ = !fs::create_directory(mark_, error);
    if (error) throw Error(mark_, "folder", error.message(), "a folder that can be written");
    lock_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (lock_ < 0 && errno == ENOENT) continue;
    if (lock_ < 0) throw Error(path, "lock", std::strerror(errno), "a file that can be written");
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
      const int reason = errno;
      ::close(lock_);
      if (reason != EWOULDBLOCK) throw Error(path, "lock", std::strerror(reason), "a file that can be locked");
      throw Error(folder_, "folder", "another run that is writing into it", "a folder of its own for each run");
    }
    if (is_still_there(lock_, path)) return;
    ::close(lock_);
    lock_ = -1;
  }
}

RunStore::~RunStore() {
  if (lock_ < 0) return;
  if (!keep_mark_) put_mark_away();
  ::close(lock_);
}

void RunStore::begin() {
  keep_mark_ = true;
  sync_folder(folder_);
}

std::optional<std::string> RunStore::load(const std::string& key) const {
  const std::string path = path_of(mark_, key);
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(path, ignored))) return std::nullopt;
  std::string bytes;
  try {
    if (fs::is_regular_file(path)) bytes = read_regular_file(path, kLargestContent);
  } catch (const Error&) {  // an unreadable file is made anew, like a damaged one
  }
  const size_t content = bytes.find('\n') + 1;
  if (bytes.substr(0, content) == heading(key, std::string_view(bytes).substr(content)))
    return bytes.substr(content);
  std::call_once(told_, [&] {
    say("glovebench: {} is damaged or from another version of the program; such parts are computed again\n", path);
  });
  fs::remove_all(path, ignored);
  return std::nullopt;
}

void RunStore::save(const std::string& key, const std::string& content) const {
  write_file(path_of(mark_, key), heading(key, content) + content);
}

bool RunStore::put_mark_away() {
  // One step, so that nobody can lock the mark while it is removed.
  const std::string done = fmt::format("{}/{}{}", folder_, kDone, getpid());
  if (::rename(mark_.c_str(), done.c_str()) != 0) return false;
  sync_folder(folder_);
  std::error_code ignored;  // the next run removes leftovers
  fs::remove_all(done, ignored);
  return true;
}

void RunStore::finish() {
  if (!put_mark_away()) throw Error(mark_, "folder", std::strerror(errno), "a mark that can be removed");
  ::close(lock_);
  lock_ = -1;
}

void require_finished(const std::string& folder) {
  std::error_code error;
  const bool is_marked = fs::exists(folder + kMark, error);
  if (error) throw Error(folder + kMark, "mark", error.message(), "a folder that can be looked into");
  if (!is_marked) return;
  throw reports::Incomparable(folder, "run", "an unfinished one (.unfinished)",
                              "a finished one: the same command again resumes it where it stopped");
}

}  // namespace glovebench::eval
