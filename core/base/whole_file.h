#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/base/mapped_memory.h"
#include "core/base/output_target.h"

namespace glovebench {

/// A file that is written whole: to a temporary name beside the target, flushed, then renamed by `commit`, so that
/// a reader sees the old content or the new one and a full disk leaves the old one. Creates missing folders.
/// Without `commit` nothing stays. Every function throws Error.
///
/// A file that is replaced keeps its mode and, if the process may set it, its owner; not its access lists. Of a
/// symbolic link the target is replaced. Another hard link keeps the old content. Devices, pipes and "-" (standard
/// output) are opened at the first `append` and written through (output_target.h).
class WholeFile {
 public:
  explicit WholeFile(const std::string& path);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void append(std::string_view content);
  /// Gives an empty file that many bytes, all zero, for which there is room on the disk, to write them through
  /// memory. Not for a device or a pipe.
  MappedMemory map(uint64_t bytes);
  /// Afterwards a power failure takes neither the content nor the name. `sync_folder` false: the name is safe only
  /// when the caller has synced the folder.
  void commit(bool sync_folder = true);

 private:
  std::string path_;  ///< as it was given
  OutputTarget target_;
  std::string temporary_;
  int descriptor_ = -1;
};

/// Writes all of a file through WholeFile.
void write_file(const std::string& path, std::string_view content);

/// Writes all of a text to an open file. Returns 0, or the number of the error that ended it.
int write_all(int descriptor, std::string_view content);

/// Removes from a folder the temporary files of writes that a kill or a crash ended, of files with such names. For
/// whoever knows that no other process is writing them.
void remove_leftovers(const std::string& folder, const std::function<bool(const std::string& name)>& is_such);

}  // namespace glovebench
