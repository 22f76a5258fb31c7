#pragma once

#include <sys/stat.h>

#include <optional>
#include <string>

namespace glovebench {

/// Where an output goes. What is replaced is a regular file: of a symbolic link its target, which may not exist
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
int create_like(const std::optional<struct stat>& older, const std::string& new_path);

/// Creates a folder and those above it, and syncs the folders that hold the new ones. An empty path is the current
/// folder. Throws Error.
void make_folders(const std::string& folder);
/// What was created, renamed or removed in a folder survives a power failure. Throws Error if the disk fails. File
/// systems that cannot sync folders are left alone.
void sync_folder(const std::string& folder);
/// The folder that holds a path; "." for a plain name.
std::string folder_above(const std::string& path);

}  // namespace glovebench
