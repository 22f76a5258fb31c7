#include "core/database/database_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/base/name.h"

namespace glovebench {
namespace {

/// An exclusive lock on a file; the kernel frees it even if the process is killed.
class FileLock {
 public:
  explicit FileLock(const std::string& path)
      : descriptor_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
    if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX) != 0) {
      throw Error(path, "lock", std::strerror(errno), "a cache folder that can be written");
    }
  }
  ~FileLock() { ::close(descriptor_); }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace

Database DatabaseCache::get(const PostureSet& postures, const HandModel& model, const ViewConfig& views,
                            std::span<const int> sizes) const {
  const std::string hash = Database::input_hash(postures, model, views);
  const std::string file = path(postures, model, views);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error(folder, "cache folder", error.message(), "a folder that can be written");

  const FileLock lock(file + ".lock");
  const auto load = [&] { return tbb::task_arena(threads).execute([&] { return Database::load(file, sizes); }); };
  if (std::filesystem::exists(file)) {
    try {
      Database database = load();
      if (database.hash() == hash && database.memory() == memory) return database;
      message(database.hash() == hash ? fmt::format("{}: memory: found {}, expected {}; rebuilding it", file,
                                                    to_string(database.memory()), to_string(memory))
                                      : file + ": made of other inputs; rebuilding it");
    } catch (const Error& e) {
      message(fmt::format("{}; rebuilding it", e.what()));
    }
  }
  // What a killed build left, as large as a database; no other process builds this one.
  remove_leftovers(folder, [&](const std::string& name) { return folder + "/" + name == file; });
  Database::build_file(file, postures, model, views, renderers, threads, progress, kTinySizes, memory);
  return load();
}

std::string DatabaseCache::path(const PostureSet& postures, const HandModel& model, const ViewConfig& views) const {
  const std::string hash = Database::input_hash(postures, model, views);
  return path_within(folder, fmt::format("{}-{}{}.glovedb", postures.name, hash.substr(0, 16),
                                         memory == DatabaseMemory::low ? "-low" : ""));
}

}  // namespace glovebench
