#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>

#include "core/base/hash.h"

namespace glovebench {

/// Throws: std::runtime_error unless the folder belongs to this user alone.
inline std::string shared_folder(const std::string& name) {
  std::string path = testing::TempDir() + name;
  ::mkdir(path.c_str(), 0700);
  struct stat found {};
  const bool is_own = ::lstat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode) && found.st_uid == ::geteuid() &&
                      (found.st_mode & (S_IWGRP | S_IWOTH)) == 0;
  if (!is_own) throw std::runtime_error(path + ": is no folder of this user alone");
  return path;
}

/// Private, at first empty. Removed at the end.
class TestFolder {
 public:
  TestFolder() {
    if (::mkdtemp(path_.data()) == nullptr) throw std::runtime_error(path_ + ": cannot be made");
  }
  ~TestFolder() {
    std::error_code ignored;
    if (::getpid() == owner_) std::filesystem::remove_all(path_, ignored);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  const std::string& path() const { return path_; }
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  int file_count() const {
    const std::filesystem::directory_iterator files(path_);
    return static_cast<int>(std::distance(begin(files), end(files)));
  }

 private:
  const pid_t owner_ = ::getpid();  ///< forks must not remove it
  std::string path_ = testing::TempDir() + "glovebench-test-XXXXXX";
};

/// The folder of the running test or suite, until the program ends.
inline const std::string& test_folder() {
  static std::map<const testing::TestInfo*, TestFolder> folders;
  return folders[testing::UnitTest::GetInstance()->current_test_info()].path();
}

/// A folder for expensive files, shared by all processes of this executable's build. Removes those of other builds.
inline std::string shared_test_folder() {
  namespace fs = std::filesystem;
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path home = shared_folder("glovebench-shared-" + hash_text(program.string()).substr(0, 16));
  const fs::path folder = home / std::to_string(fs::last_write_time(program).time_since_epoch().count());
  fs::create_directories(folder);
  for (const fs::directory_entry& entry : fs::directory_iterator(home)) {
    std::error_code ignored;
    if (entry.path() != folder) fs::remove_all(entry.path(), ignored);
  }
  return folder.string();
}

/// A folder in `home` that `fill` fills once; other processes wait.
inline std::string filled_once(const std::string& home, const std::string& name,
                               const std::function<void(const std::string& folder)>& fill) {
  namespace fs = std::filesystem;
  const std::string folder = home + "/" + name, half = folder + ".half";
  const int lock = ::open((folder + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (lock < 0 || ::flock(lock, LOCK_EX) != 0) throw std::runtime_error(folder + ": cannot be locked");
  if (!fs::exists(folder)) {
    fs::remove_all(half);  // of a process that was killed
    fs::create_directories(half);
    fill(half);
    fs::rename(half, folder);
  }
  ::close(lock);
  return folder;
}

}  // namespace glovebench
