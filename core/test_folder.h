#pragma once

// Folders for the tests of this module.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "core/base/hash.h"

namespace glovebench {

/// A folder of one test's own: empty at first, gone at the end.
class TestFolder {
 public:
  TestFolder() { std::filesystem::create_directories(path_); }
  ~TestFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
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
  std::string path_ = testing::TempDir() + "glovebench-test-" + std::to_string(getpid());
};

/// A folder that all test processes of this executable share, for what is expensive to make. Another build gets
/// another one, so that no test is answered by the files of older code; those are removed.
inline std::string shared_test_folder() {
  namespace fs = std::filesystem;
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path home = testing::TempDir() + "glovebench-shared-" + hash_text(program.string()).substr(0, 16);
  const fs::path folder = home / std::to_string(fs::last_write_time(program).time_since_epoch().count());
  fs::create_directories(folder);
  for (const fs::directory_entry& entry : fs::directory_iterator(home)) {
    std::error_code ignored;
    if (entry.path() != folder) fs::remove_all(entry.path(), ignored);
  }
  return folder.string();
}

}  // namespace glovebench
