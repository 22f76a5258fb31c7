#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/mapped_memory.h"

namespace glovebench {

/// Files are refused from this size on where nobody says what they may hold.
inline constexpr uint64_t kLargestUnknownFile = uint64_t{256} << 20;

/// The whole content of a regular file or a pipe (InputFile). Throws Error if it is missing, cannot be read or is
/// larger than `max_bytes`, of which a reader says how many its files may have (core/README.md).
std::string read_file(const std::string& path, uint64_t max_bytes = kLargestUnknownFile);

/// A file that is written whole: to a temporary name beside the target, flushed, then renamed by `commit`, so that
/// a reader sees the old content or the new one and a full disk leaves the old one. Creates missing folders.
/// Without `commit` nothing stays. Every function throws Error.
class WholeFile {
 public:
  explicit WholeFile(const std::string& path);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void append(std::string_view content);
  /// Gives an empty file that many bytes, all zero, for which there is room on the disk, to write them through
  /// memory.
  MappedMemory map(uint64_t bytes);
  void commit();

 private:
  std::string path_;
  std::string temporary_;
  int descriptor_ = -1;
};

/// Files of one folder, none of which replaces an older one before there was room for all.
class WholeFiles {
 public:
  explicit WholeFiles(std::string folder) : folder_(std::move(folder)) {}

  /// Throws Error.
  void add(const std::string& name, std::string_view content);
  const std::vector<std::string>& names() const { return names_; }
  /// In the order in which they were added. Throws Error.
  void commit();

 private:
  std::string folder_;
  std::vector<std::string> names_;
  std::vector<std::unique_ptr<WholeFile>> files_;
};

/// Writes all of a file through WholeFile.
void write_file(const std::string& path, std::string_view content);

/// Removes from a folder the temporary files of writes that a kill or a crash ended, of files with such names. For
/// whoever knows that no other process is writing them.
void remove_leftovers(const std::string& folder, const std::function<bool(const std::string& name)>& is_such);

}  // namespace glovebench
