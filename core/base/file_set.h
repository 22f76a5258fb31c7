#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"

namespace glovebench {

// Files of one folder that belong together: a run's report, a comparison, a baseline. `manifest.json` in the folder
// names each file, its size and its hash, and says which set is the current one:
//
//   1. The new files are written and synced in FOLDER/.staged/. The manifest is the old one: the set is the old
//   one.
//   2. The new manifest replaces the old one, by a rename. From here on the set is the new one.
//   3. The files move from .staged to their places; files of the old set that the new one lacks are removed.
//
// A reader takes a file from its place if its hash is the manifest's, else from .staged. So it reads all of the old
// set or all of the new one, wherever a kill or a power failure ended the writer; the next writer first finishes
// step 3. A folder without a manifest is older than manifests or was made by hand: its files are read as they are.
//
// The manifest also says of what kind the set is. A writer replaces and removes sets of its own kind alone.

inline constexpr const char* kManifest = "manifest.json";
/// Bytes, for readers and writers: 1.7 million files of a recording, more than 7 hours.
inline constexpr uint64_t kLargestManifest = uint64_t{256} << 20;
/// The kinds of sets.
inline constexpr const char *kRunSet = "run", *kComparisonSet = "comparison", *kBaselineSet = "baseline",
                            *kRecordingSet = "recording";

/// A file is missing or has another content than the manifest says: it was changed, or it is damaged.
class BrokenSet : public Error {
 public:
  using Error::Error;
};

struct ManifestEntry {
  std::string name;  ///< its path in the folder
  uint64_t bytes = 0;
  std::string hash;  ///< core/base/hash.h
};
struct Manifest {
  std::string kind;  ///< empty: written before manifests had kinds
  std::vector<ManifestEntry> files;
};
/// Throws Error if it is larger.
std::string manifest_json(const Manifest& manifest, uint64_t max_bytes = kLargestManifest);
/// Any kind. Throws Error. A name that leads out of the folder is one.
Manifest parse_manifest(const std::string& text, const std::string& where);
/// None if the folder has no manifest. Throws Error if it cannot be read.
std::optional<Manifest> read_manifest(const std::string& folder);
/// The manifest that a writer of this kind may replace; none if the folder has none. Throws Error if it is no
/// regular file, cannot be read or is of another kind.
std::optional<Manifest> manifest_to_replace(const std::string& folder, const std::string& kind);

/// A set to read. All reads through one object are of one set.
class FileSet {
 public:
  /// Throws Error if there is a manifest that cannot be read.
  explicit FileSet(std::string folder) : folder_(std::move(folder)), manifest_(read_manifest(folder_)) {}

  /// The manifest names the file; without a manifest: it is there.
  bool has(const std::string& name) const;
  /// What messages call the file.
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  /// Throws BrokenSet if the manifest does not name the file or the file is not what the manifest says; Error if it
  /// cannot be read or is larger.
  std::string read(const std::string& name, uint64_t max_bytes = std::numeric_limits<uint64_t>::max()) const;
  /// Throws BrokenSet if the manifest names the file and says that its content is another.
  void expect_content(const std::string& name, std::string_view content) const;

 private:
  [[noreturn]] void fail(const ManifestEntry& entry) const;

  std::string folder_;
  std::optional<Manifest> manifest_;
};

/// Held while a set is written. Waits for another holder. A file system that cannot lock folders does without.
class FolderLock {
 public:
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

/// A set to write. Creates the folder, and waits while another process writes a set into it. A folder that holds a
/// set of another kind, or a manifest that cannot be read, is an error and stays as it is. A full disk, an error or
/// a missing `commit` leaves the older set. Files that no set names stay as they are, unless one of them has the
/// name of a new file; so do files of the older set that somebody changed. Every function throws Error.
class WholeFiles {
 public:
  WholeFiles(const std::string& folder, const std::string& kind);
  ~WholeFiles();
  WholeFiles(const WholeFiles&) = delete;
  WholeFiles& operator=(const WholeFiles&) = delete;

  /// `name` may have folders of its own, but stays in the folder (core/base/name.h). In its place may be a regular
  /// file, whose mode the new one takes, or nothing; a link is an error.
  void add(const std::string& name, std::string_view content);
  /// A file of the folder, if it is there, belongs to the new set as it is.
  void keep(const std::string& name);
  /// What `add` was given, in its order.
  std::vector<std::string> names() const;
  void commit();

 private:
  std::string folder_;
  std::string kind_;
  FolderLock lock_;
  std::vector<ManifestEntry> files_;
  std::vector<std::string> kept_;
  bool is_committed_ = false;
};

/// Finishes an interrupted write, then removes a set of this kind: the files that still have the manifest's
/// content, then the manifest. Without a manifest nothing. Throws Error if a file cannot be removed; and, with
/// nothing removed, if the folder holds a set of another kind or a manifest that cannot be read.
void remove_set(const std::string& folder, const std::string& kind);

}  // namespace glovebench
