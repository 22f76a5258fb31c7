#pragma once

#include <sys/types.h>

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"

namespace glovebench {

// A set is files of a folder that change together (core/base/README.md).

inline constexpr const char* kManifest = "manifest.json";
/// Bytes.
inline constexpr uint64_t kLargestManifest = uint64_t{256} << 20;

/// A file is missing, changed or damaged.
class BrokenSet : public Error {
 public:
  using Error::Error;
};

struct ManifestEntry {
  uint64_t bytes = 0;
  std::string hash;
};
using Manifest = std::map<std::string, ManifestEntry>;

/// Throws: Error beyond `max_bytes`.
std::string manifest_json(const Manifest& manifest, uint64_t max_bytes = kLargestManifest);
/// Throws: Error, also if a name leads out of the folder.
Manifest parse_manifest(const std::string& text, const std::string& where);
/// Empty if the folder has none.
/// Throws: Error if it is unreadable.
std::optional<Manifest> read_manifest(const std::string& folder);
/// For what is written by the flag --output.
/// Throws: Error if one of the files exists, unless the folder's manifest names it and the first.
void require_own_files(const std::string& folder, std::initializer_list<const char*> names);

/// Reads files of one state of the folder.
class FileSet {
 public:
  /// Throws: Error as read_manifest.
  explicit FileSet(std::string folder) : folder_(std::move(folder)), manifest_(read_manifest(folder_)) {}

  const std::string& folder() const { return folder_; }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  /// True if the manifest names it or, without a manifest, it exists.
  bool has(const std::string& name) const;
  /// Throws: BrokenSet if it differs from the manifest, Error if it is unreadable or too large.
  std::string read(const std::string& name, uint64_t max_bytes = std::numeric_limits<uint64_t>::max()) const;

  struct Found {
    std::string content;
    bool is_changed = false;
  };
  /// Reads a file that may differ from the manifest or be missing there.
  /// Throws: Error.
  Found find(const std::string& name, uint64_t max_bytes) const;
  /// Throws: BrokenSet.
  [[noreturn]] void refuse(const std::string& name) const;

 private:
  const ManifestEntry* entry(const std::string& name) const;
  std::optional<std::string> as_written(const std::string& name, const ManifestEntry& entry,
                                        uint64_t max_bytes) const;

  std::string folder_;
  std::optional<Manifest> manifest_;
};

/// Locks a folder for one writer, if the file system can.
/// Throws: Error if another process holds it for over 10 s.
class FolderLock {
 public:
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

/// Writes a set under a FolderLock. Other files stay. Nothing changes until `commit`.
/// Throws: Error, from every function.
class WholeFiles {
 public:
  explicit WholeFiles(const std::string& folder);
  ~WholeFiles();
  WholeFiles(const WholeFiles&) = delete;
  WholeFiles& operator=(const WholeFiles&) = delete;

  const Manifest& manifest() const { return manifest_; }
  /// `name` may contain folders. A replaced file keeps its mode. A new manifest gets the permissions common to all
  /// files.
  /// Throws: Error, also for a link.
  void add(const std::string& name, std::string_view content, mode_t mode = 0644);
  void remove(const std::string& name);
  const std::vector<std::string>& names() const { return added_; }
  void commit();

 private:
  std::string folder_;
  FolderLock lock_;
  Manifest manifest_;
  std::vector<std::string> added_, removed_;
  mode_t mode_ = 0644;
  bool is_committed_ = false;
};

}  // namespace glovebench
