#pragma once

#include <sys/stat.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/mapped_memory.h"

namespace glovebench {

/// Where an output goes. A regular file is replaced; of a symbolic link the target is, which may not exist
/// yet. Devices, pipes, "-" (standard output) and open descriptors (/dev/stdout, /dev/fd/3) are written through.
struct OutputTarget {
  bool is_stream = false;                 ///< is written through
  int descriptor = -1;                    ///< of a stream that is open already
  std::string path;                       ///< of the file or device, links followed
  std::optional<struct stat> older = {};  ///< of the file that is there
};

/// Throws Error if it is a folder, or links that lead in a circle.
OutputTarget find_output(const std::string& path);

/// Opens a target that is written through. Waits for the reader of a named pipe. Throws Error naming `path`.
int open_stream(const OutputTarget& target, const std::string& path);

/// Creates a file that is not there yet, with the mode of the older file and, as far as the process may, its owner.
/// A negative number leaves the reason in errno.
int create_like(const std::optional<struct stat>& older, const std::string& new_path, mode_t mode = 0644);

/// The outcome of a write.
struct Written {
  size_t bytes = 0;  ///< that were written
  int error = 0;     ///< 0, or the number of the error that ended it
};
Written write_all(int descriptor, std::string_view content);

/// Makes what was written to a file survive a power failure. Pipes and most devices hold nothing that could be
/// synced. Returns 0 or the number of the error.
int sync_file(int descriptor);

/// Creates a folder and those above it, and syncs the folders that hold the new ones. An empty path is the current
/// folder. Throws Error.
void make_folders(const std::string& folder);
/// Makes what was created, renamed or removed in a folder survive a power failure. Throws Error if the disk fails.
/// File systems that cannot sync folders are left alone.
void sync_folder(const std::string& folder);
/// The folder that holds a path; "." for a plain name.
std::string folder_above(const std::string& path);

/// A file that is written whole: to a temporary name beside the target, flushed, then renamed by `commit`, so that
/// a reader sees the old content or the new one and a full disk leaves the old one. Creates missing folders.
/// Without `commit` nothing stays. Every function throws Error.
///
/// A file that is replaced keeps its mode and, if the process may set it, its owner; not its access lists. Another
/// hard link keeps the old content. A target that is written through is opened at the first `append`.
class WholeFile {
 public:
  /// `mode`: of a file that is not there yet.
  explicit WholeFile(const std::string& path, mode_t mode = 0644);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void append(std::string_view content);
  /// Gives an empty file that many bytes, all zero, for which there is room on the disk, to write them through
  /// memory. Not for a device or a pipe.
  MappedMemory map(uint64_t bytes);
  /// Afterwards a power failure takes neither the content nor the name.
  void commit();

 private:
  std::string path_;  ///< as it was given
  OutputTarget target_;
  std::string temporary_;
  int descriptor_ = -1;
};

/// Writes all of a file through WholeFile.
void write_file(const std::string& path, std::string_view content);

/// Removes from a folder the temporary files of writes that a kill or a crash ended, of files with such names; not
/// those that are being written, which are locked. A file system that cannot lock keeps all.
void remove_leftovers(const std::string& folder, const std::function<bool(const std::string& name)>& is_such);

}  // namespace glovebench
