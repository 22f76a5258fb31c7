#pragma once

#include <sys/types.h>

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"

namespace glovebench {

// Files of one folder that change together: a run's report, a comparison, a baseline, a recording. `manifest.json`
// in the folder names each of them, its size and its hash. A write has three steps:
//
//   1. The new files are written and synced in FOLDER/.staged/. The manifest is still the older one.
//   2. The new manifest replaces the older one, by a rename.
//   3. The files move from .staged to their places; the files that the write removes go.
//
// A reader takes a file from its place if its hash is the manifest's, else from .staged. So it reads the state
// before the write or the one after it, wherever a kill or a power failure ended the writer; the next writer first
// finishes step 3. A folder without a manifest is older than manifests or was made by hand: its files are read as
// they are.
//
// A write replaces and removes the files that it names. All other files, and their entries of the manifest, stay.

inline constexpr const char* kManifest = "manifest.json";
/// Bytes, for readers and writers: 1.7 million files of a recording, more than 7 hours.
inline constexpr uint64_t kLargestManifest = uint64_t{256} << 20;

/// A file is missing or has another content than the manifest says: it was changed, or it is damaged.
class BrokenSet : public Error {
 public:
  using Error::Error;
};

struct ManifestEntry {
  uint64_t bytes = 0;
  std::string hash;  ///< core/base/hash.h
};
/// By the file's path in the folder.
using Manifest = std::map<std::string, ManifestEntry>;

/// Throws Error if it is larger.
std::string manifest_json(const Manifest& manifest, uint64_t max_bytes = kLargestManifest);
/// Throws Error. A name that leads out of the folder is one.
Manifest parse_manifest(const std::string& text, const std::string& where);
/// None if the folder has no manifest. Throws Error if it cannot be read.
std::optional<Manifest> read_manifest(const std::string& folder);

/// A folder's files to read. All reads through one object are of one state of the folder.
class FileSet {
 public:
  /// Throws Error if there is a manifest that cannot be read.
  explicit FileSet(std::string folder) : folder_(std::move(folder)), manifest_(read_manifest(folder_)) {}

  const std::string& folder() const { return folder_; }
  /// What messages call the file.
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  /// The manifest names the file; without a manifest: it is there.
  bool has(const std::string& name) const;
  /// Throws BrokenSet if the manifest does not name the file or the file is not what the manifest says; Error if it
  /// cannot be read or is larger.
  std::string read(const std::string& name, uint64_t max_bytes = std::numeric_limits<uint64_t>::max()) const;

  struct Found {
    std::string content;
    bool is_changed = false;  ///< the manifest says that the content is another
  };
  /// The same of a file that a user may change or add by hand: then it is read as it is. Throws Error.
  Found find(const std::string& name, uint64_t max_bytes) const;
  /// Throws BrokenSet about a file that was changed.
  [[noreturn]] void refuse(const std::string& name) const;

 private:
  const ManifestEntry* entry(const std::string& name) const;
  std::optional<std::string> as_written(const std::string& name, const ManifestEntry& entry,
                                        uint64_t max_bytes) const;

  std::string folder_;
  std::optional<Manifest> manifest_;
};

/// Held while a folder is written. Throws Error if another holder keeps it for more than ten seconds. A file system
/// that cannot lock folders does without.
class FolderLock {
 public:
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

/// A write of files that change together. Creates the folder, and waits for ten seconds if another process writes
/// into it. A manifest that cannot be read is an error and stays as it is. A full disk, an error or a missing
/// `commit` leaves the older files. Every function throws Error.
class WholeFiles {
 public:
  explicit WholeFiles(const std::string& folder);
  ~WholeFiles();
  WholeFiles(const WholeFiles&) = delete;
  WholeFiles& operator=(const WholeFiles&) = delete;

  /// The manifest after `commit`.
  const Manifest& manifest() const { return manifest_; }
  /// `name` may have folders of its own, but stays in the folder (core/base/text.h). In its place may be a regular
  /// file, whose mode the new one takes, or nothing; a link is an error. A new manifest is as private as the most
  /// private of the files.
  void add(const std::string& name, std::string_view content, mode_t mode = 0644);
  /// The file goes, if it is there.
  void remove(const std::string& name);
  /// What `add` was given, in its order.
  const std::vector<std::string>& names() const { return added_; }
  void commit();

 private:
  std::string folder_;
  FolderLock lock_;
  Manifest manifest_;
  std::vector<std::string> added_, removed_;
  mode_t mode_ = 0644;  ///< of a new manifest
  bool is_committed_ = false;
};

}  // namespace glovebench
