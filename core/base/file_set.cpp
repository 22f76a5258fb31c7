#include "core/base/file_set.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <set>

#include "core/base/check.h"
#include "core/base/excerpt.h"
#include "core/base/hash.h"
#include "core/base/input_file.h"
#include "core/base/name.h"
#include "core/base/staged_files.h"
#include "core/base/whole_file.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;

/// The manifest that is replaced, in the staging folder: it names what has to be removed.
constexpr const char* kOlder = ".older-manifest";

bool is_file(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(fs::symlink_status(path, ignored));
}
bool is_content(const std::string& path, const ManifestEntry& file) {
  std::error_code error;
  return is_file(path) && fs::file_size(path, error) == file.bytes && !error && hash_file(path) == file.hash;
}

/// Throws Error if something is in the place of a new file that the file could not replace.
std::optional<struct stat> file_in_place(const std::string& path) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0) return std::nullopt;
  if (!S_ISREG(found.st_mode)) {
    throw Error(path, "file",
                S_ISDIR(found.st_mode)   ? "a folder"
                : S_ISLNK(found.st_mode) ? "a link"
                                         : "a device",
                "a regular file, or nothing");
  }
  return found;
}

std::set<std::string> folders_of(const std::string& folder, const std::vector<ManifestEntry>& files) {
  std::set<std::string> folders = {folder};
  for (const ManifestEntry& file : files) folders.insert(folder_above(folder + "/" + file.name));
  return folders;
}

void remove_file(const std::string& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw Error(path, "file", error.message(), "a file that can be removed");
}

/// None if there is none. Throws Error if it is no regular file or cannot be read.
std::optional<Manifest> own_manifest(const std::string& folder) {
  file_in_place(folder + "/" + kManifest);
  return read_manifest(folder);
}

/// The files that a set may have replaced; none if that is not known any more.
std::vector<ManifestEntry> older_files(const std::string& staged) {
  const std::string path = staged + "/" + kOlder;
  try {
    if (is_file(path)) return parse_manifest(read_file(path), path).files;
  } catch (const Error&) {
  }
  return {};
}

void place_files(const std::string& folder, const std::vector<ManifestEntry>& files) {
  const std::string staged = staged_folder(folder);
  for (const ManifestEntry& file : files) {
    const std::string place = place_within(folder, file.name), from = place_within(staged, file.name);
    if (!is_content(from, file) || is_content(place, file)) continue;
    make_folders(folder_above(place));
    if (std::rename(from.c_str(), place.c_str()) != 0)
      throw Error(place, "file", std::strerror(errno), "a file that can be replaced");
  }
  for (const ManifestEntry& old : older_files(staged)) {
    const bool is_kept = std::ranges::find(files, old.name, &ManifestEntry::name) != files.end();
    std::error_code ignored;
    if (!is_kept && is_content(place_within(folder, old.name), old)) fs::remove(folder + "/" + old.name, ignored);
  }
  for (const std::string& changed : folders_of(folder, files)) sync_folder(changed);
}

}  // namespace

std::optional<Manifest> manifest_to_replace(const std::string& folder, const std::string& kind) {
  std::optional<Manifest> manifest = own_manifest(folder);
  if (manifest && manifest->kind != kind)
    throw Error(folder + "/" + kManifest, "kind", quoted_excerpt(manifest->kind),
                kind + ", or a folder without a manifest");
  return manifest;
}

void put_in_place(const std::string& folder) {
  const std::string staged = staged_folder(folder);
  std::error_code error;
  const fs::file_status found = fs::symlink_status(staged, error);
  if (!fs::exists(found)) return;
  if (!fs::is_directory(found)) throw Error(staged, "file", "no folder", "a folder, or nothing");
  // Without a manifest nobody knows of a set, and what is staged belongs to none.
  if (const std::optional<Manifest> manifest = own_manifest(folder)) place_files(folder, manifest->files);
  fs::remove_all(staged, error);
  if (error) throw Error(staged, "folder", error.message(), "one that can be removed");
}

FolderLock::FolderLock(const std::string& folder)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  while (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) continue;
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

WholeFiles::WholeFiles(const std::string& folder, const std::string& kind)
    : folder_((make_folders(folder), folder)), kind_(kind), lock_(folder) {
  manifest_to_replace(folder_, kind_);
  put_in_place(folder_);
  remove_leftovers(folder_, [](const std::string& name) { return name == kManifest; });
}

WholeFiles::~WholeFiles() {
  std::error_code ignored;
  if (!is_committed_) fs::remove_all(staged_folder(folder_), ignored);
}

void WholeFiles::add(const std::string& name, std::string_view content) {
  check(name != kManifest && std::ranges::find(files_, name, &ManifestEntry::name) == files_.end(),
        "a set holds each name once, beside the manifest");
  const std::optional<struct stat> older = file_in_place(place_within(folder_, name));
  const std::string path = staged_path(folder_, name);
  make_folders(folder_above(path));
  const int descriptor = create_like(older, path);
  int error = descriptor < 0 ? errno : write_all(descriptor, content).error;
  if (error == 0) error = sync_file(descriptor);
  if (descriptor >= 0) ::close(descriptor);
  if (error != 0) throw Error(folder_ + "/" + name, "file", std::strerror(error), "room to write it whole");
  files_.push_back({name, content.size(), hash_text(std::string(content))});
}

void WholeFiles::keep(const std::string& name) {
  if (is_file(place_within(folder_, name))) kept_.push_back(name);
}

std::vector<std::string> WholeFiles::names() const {
  std::vector<std::string> names;
  for (const ManifestEntry& file : files_) names.push_back(file.name);
  return names;
}

void WholeFiles::commit() {
  Manifest made{kind_, files_};
  std::vector<ManifestEntry>& files = made.files;
  for (const std::string& name : kept_) {
    const std::string path = place_within(folder_, name);
    files.push_back({name, fs::file_size(path), hash_file(path)});
  }
  const std::string staged = staged_folder(folder_), manifest = folder_ + "/" + kManifest;
  make_folders(staged);
  // Before the manifest: afterwards an error could only be reported.
  for (const std::string& needed : folders_of(folder_, files)) make_folders(needed);
  write_file(staged + "/" + kOlder,
             manifest_json(manifest_to_replace(folder_, kind_).value_or(Manifest{kind_, {}})));
  for (const std::string& changed : folders_of(staged, files_)) sync_folder(changed);
  sync_folder(folder_);
  WholeFile file(manifest);
  file.append(manifest_json(made));
  is_committed_ = true;  // whatever fails from here on, the staged files may be the set
  file.commit();
  put_in_place(folder_);
}

void remove_set(const std::string& folder, const std::string& kind) {
  const FolderLock lock(folder);
  const std::optional<Manifest> manifest = manifest_to_replace(folder, kind);
  if (!manifest) return;
  for (const ManifestEntry& file : manifest->files) place_within(folder, file.name);  // before anything is removed
  put_in_place(folder);
  // The manifest goes last: until then it says which files are left to remove.
  for (const ManifestEntry& file : manifest->files)
    if (const std::string path = place_within(folder, file.name); is_content(path, file)) remove_file(path);
  for (const std::string& changed : folders_of(folder, manifest->files)) sync_folder(changed);
  remove_file(folder + "/" + kManifest);
  sync_folder(folder);
}

}  // namespace glovebench
