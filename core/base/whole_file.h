#pragma once

#include <sys/stat.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/mapped_memory.h"

namespace glovebench {

/// A file or a stream (device, pipe, "-", /dev/fd/3): core/base/README.md.
struct OutputTarget {
  bool is_stream = false;
  int descriptor = -1;  ///< of an open stream
  std::string path;
  std::optional<struct stat> older = {};
};

/// Throws: Error for a folder or a circle of links.
OutputTarget find_output(const std::string& path);

/// Waits for a pipe's reader.
/// Throws: Error.
int open_stream(const OutputTarget& target, const std::string& path);

/// Creates a file with the older one's mode and, if permitted, owner. On failure returns -1 and sets errno.
int create_like(const std::optional<struct stat>& older, const std::string& new_path, mode_t mode = 0644);

struct Written {
  size_t bytes = 0;
  int error = 0;  ///< errno; 0: none
};
Written write_all(int descriptor, std::string_view content);

/// Returns 0 or errno.
int sync_file(int descriptor);

/// Creates and syncs a folder and its parents. "": the current one.
/// Throws: Error.
void make_folders(const std::string& folder);
/// Syncs new names, if the file system can.
/// Throws: Error if the disk fails.
void sync_folder(const std::string& folder);
/// "." for a plain name.
std::string folder_above(const std::string& path);

/// Writes a whole file (core/base/README.md). The old file stays until `commit`. Creates missing folders. Opens
/// streams at the first `append`.
/// Throws: Error, from every function.
class WholeFile {
 public:
  explicit WholeFile(const std::string& path, mode_t mode = 0644);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void append(std::string_view content);
  /// Fills an empty file with zeros on the disk and maps it for writing. Not for streams.
  MappedMemory map(uint64_t bytes);
  /// Content and name then survive a power failure.
  void commit();

 private:
  std::string path_;
  OutputTarget target_;
  std::string temporary_;
  int descriptor_ = -1;
};

void write_file(const std::string& path, std::string_view content);

/// Removes temporary files of killed writers if `is_such` accepts the target's name. Locked files stay.
void remove_leftovers(const std::string& folder, const std::function<bool(const std::string& name)>& is_such);

}  // namespace glovebench
