#include "core/database/database_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/text.h"
#include "core/base/whole_file.h"

namespace glovebench {
namespace {

/// An exclusive lock on a file; the kernel frees it even if the process is killed.
class FileLock {
 public:
  explicit FileLock(const std::string& path)
      : descriptor_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
    if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX) != 0)
      throw Error(path, "lock", std::strerror(errno), "a cache folder that can be written");
  }
  ~FileLock() { ::close(descriptor_); }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_;
};

/// Begin of the names of all files of these inputs.
std::string stem(const DatabaseCache& cache, const PostureSet& postures, const std::string& input_hash) {
  return fmt::format("{}-{}{}", postures.name, input_hash.substr(0, 16),
                     cache.memory == DatabaseMemory::low ? "-low" : "");
}

/// Removes files of the same inputs by other code, since each change of the code leaves another large file.
void remove_outdated(const DatabaseCache& cache, const std::string& stem, const std::string& file) {
  constexpr size_t kSourceHash = 17;  // with its hyphen
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(cache.folder, ignored)) {
    const std::string name = entry.path().filename();
    const bool is_of_inputs =
        name.starts_with(stem) && name.ends_with(kDatabaseEnding) &&
        (name.size() == stem.size() + kDatabaseEnding.size() ||  // before there was a source hash
         name.size() == stem.size() + kSourceHash + kDatabaseEnding.size());
    if (is_of_inputs && entry.path() != file && entry.is_regular_file(ignored))
      std::filesystem::remove(entry.path(), ignored);
  }
}

}  // namespace

Database DatabaseCache::get(const PostureSet& postures, const HandModel& model, const ViewConfig& views,
                            std::span<const int> sizes) const {
  const std::string hash = Database::input_hash(postures, model, views);
  const std::string file = path(postures, model, views), begin = stem(*this, postures, hash);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error(folder, "cache folder", error.message(), "a folder that can be written");

  const FileLock lock(folder + "/" + begin + ".lock");
  const auto load = [&] { return tbb::task_arena(threads).execute([&] { return Database::load(file, sizes); }); };
  if (std::filesystem::exists(file)) {
    try {
      Database database = load();
      if (database.input_hash() == hash && database.memory() == memory) return database;
      message(database.input_hash() == hash ? fmt::format("{}: memory: found {}, expected {}; rebuilding it", file,
                                                          to_string(database.memory()), to_string(memory))
                                            : file + ": made of other inputs; rebuilding it");
    } catch (const Error& e) {
      message(fmt::format("{}; rebuilding it", e.what()));
    }
  }
  remove_outdated(*this, begin, file);
  Database::build_file(file, postures, model, views, renderers, threads, progress, kTinySizes, memory);
  return load();
}

std::string DatabaseCache::path(const PostureSet& postures, const HandModel& model, const ViewConfig& views) const {
  return path_within(folder,
                     fmt::format("{}-{}{}", stem(*this, postures, Database::input_hash(postures, model, views)),
                                 hash_text(source_hash).substr(0, 16), kDatabaseEnding));
}

}  // namespace glovebench
