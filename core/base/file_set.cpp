#include "core/base/file_set.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "core/base/hash.h"
#include "core/base/input_file.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "core/base/text.h"
#include "core/base/whole_file.h"

namespace glovebench {
namespace {

/// How long a writer waits for another one: a report is written in a second, a recording in minutes.
constexpr std::chrono::seconds kLockWait{10};

namespace fs = std::filesystem;

/// Older manifests also have a `kind`, which nobody reads.
constexpr const char* kFormat = "glovebench-manifest";
/// Lines in the staging folder: the hash of the new manifest, then the files that the write removes.
constexpr const char* kRemoved = ".removed";

std::string staged_folder(const std::string& folder) { return folder + "/.staged"; }

std::pair<std::string, ManifestEntry> entry_from(const JsonCursor& file, const std::string& where) {
  file.expect_keys({"name", "bytes", "hash"});
  const std::string name = file["name"].text();
  path_within(where, name);
  return {name, {file["bytes"].unsigned_integer(), file["hash"].text()}};
}

/// The content of a file if it matches the manifest.
std::optional<std::string> content_of(const std::string& path, const ManifestEntry& entry, uint64_t max_bytes) {
  std::error_code error;
  if (fs::file_size(path, error) != entry.bytes || error) return std::nullopt;
  std::string content;
  try {
    content = read_regular_file(path, max_bytes);
  } catch (const Error&) {
    // The writer moved it meanwhile, and may have put the next one there.
    const bool was_moved = ::access(path.c_str(), R_OK) == 0 || errno == ENOENT;
    if (was_moved && entry.bytes <= max_bytes) return std::nullopt;
    throw;
  }
  if (hash_text(content) != entry.hash) return std::nullopt;
  return content;
}

bool is_file(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(fs::symlink_status(path, ignored));
}

/// Throws: Error if the place holds something that a new file cannot replace.
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

/// Writes a new file, which messages call `place`.
void write_new_file(const std::string& path, std::string_view content, const std::optional<struct stat>& older,
                    mode_t mode, const std::string& place) {
  make_folders(folder_above(path));
  const int descriptor = create_like(older, path, mode);
  int error = descriptor < 0 ? errno : write_all(descriptor, content).error;
  if (error == 0) error = sync_file(descriptor);
  if (descriptor >= 0) ::close(descriptor);
  if (error != 0) throw Error(place, "file", std::strerror(error), "room to write it whole");
}

/// Empty without a manifest.
/// Throws: Error if it is not a regular file or is unreadable.
std::optional<Manifest> own_manifest(const std::string& folder) {
  file_in_place(folder + "/" + kManifest);
  return read_manifest(folder);
}

std::set<std::string> folders_of(const std::string& folder, const std::vector<std::string>& names) {
  std::set<std::string> folders = {folder};
  for (const std::string& name : names) folders.insert(folder_above(folder + "/" + name));
  return folders;
}

/// Step 3 of a write.
void place_files(const std::string& folder, const std::vector<std::string>& added,
                 const std::vector<std::string>& removed) {
  const std::string staged = staged_folder(folder);
  for (const std::string& name : added) {
    const std::string place = place_within(folder, name);
    make_folders(folder_above(place));
    if (std::rename(place_within(staged, name).c_str(), place.c_str()) != 0)
      throw Error(place, "file", std::strerror(errno), "a file that can be replaced");
  }
  std::error_code error;
  for (const std::string& name : removed)
    if (const std::string place = place_within(folder, name); is_file(place) && !fs::remove(place, error))
      throw Error(place, "file", error.message(), "a file that can be removed");
  for (const std::vector<std::string>* names : {&added, &removed})
    for (const std::string& changed : folders_of(folder, *names)) sync_folder(changed);
  fs::remove_all(staged, error);
  if (error) throw Error(staged, "folder", error.message(), "one that can be removed");
}

/// Finishes a write that was interrupted after step 2, and removes all other staged files.
void finish_write(const std::string& folder, const std::optional<Manifest>& manifest) {
  const std::string staged = staged_folder(folder);
  std::error_code error;
  const fs::file_status found = fs::symlink_status(staged, error);
  if (!fs::exists(found)) return;
  if (!fs::is_directory(found)) throw Error(staged, "file", "no folder", "a folder, or nothing");
  std::vector<std::string> added, removed;
  for (const auto& [name, entry] : manifest.value_or(Manifest{}))
    if (const std::string path = place_within(staged, name);
        is_file(path) && fs::file_size(path) == entry.bytes && hash_file(path) == entry.hash)
      added.push_back(name);
  if (const std::string path = staged + "/" + kRemoved; manifest && is_file(path)) {
    std::istringstream lines(read_regular_file(path, kLargestManifest));
    std::string line;
    // A list with the hash of another manifest is void: that manifest was never put in place.
    if (std::getline(lines, line) && line == hash_file(folder + "/" + kManifest))
      while (std::getline(lines, line))
        if (!manifest->contains(line)) removed.push_back(line);
  }
  place_files(folder, added, removed);
}

}  // namespace

std::string manifest_json(const Manifest& manifest, uint64_t max_bytes) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& [name, entry] : manifest)
    list.push_back({{"name", name}, {"bytes", entry.bytes}, {"hash", entry.hash}});
  const nlohmann::ordered_json json = {{"format", kFormat}, {"version", 1}, {"files", std::move(list)}};
  std::string text = json.dump(1) + "\n";
  if (text.size() > max_bytes)
    throw Error(kManifest, "size", fmt::format("{} bytes", text.size()), fmt::format("at most {}", max_bytes));
  return text;
}

Manifest parse_manifest(const std::string& text, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  const JsonCursor root(document, where);
  root.expect_format(kFormat, 1);
  Manifest manifest;
  for (const JsonCursor& file : root["files"].items()) {
    const auto [place, is_new] = manifest.insert(entry_from(file, where));
    if (!is_new) throw Error(where, "files", quoted_excerpt(place->first) + " twice", "each file once");
  }
  return manifest;
}

std::optional<Manifest> read_manifest(const std::string& folder) {
  const std::string path = folder + "/" + kManifest;
  std::error_code error;
  const bool is_there = fs::exists(path, error);
  if (error) throw Error(path, "file", error.message(), "a manifest that can be read, or none");
  if (!is_there) return std::nullopt;
  return parse_manifest(read_regular_file(path, kLargestManifest), path);
}

void require_own_files(const std::string& folder, std::initializer_list<const char*> names) {
  const Manifest manifest = read_manifest(folder).value_or(Manifest{});
  const std::string kind = *names.begin();
  for (const std::string name : names)
    if (fs::exists(folder + "/" + name) && !(manifest.contains(kind) && manifest.contains(name)))
      throw Error("--output", "folder", fmt::format("{}/{}, which no report of this kind wrote", folder, name),
                  "another folder");
}

const ManifestEntry* FileSet::entry(const std::string& name) const {
  if (!manifest_) return nullptr;
  const auto found = manifest_->find(name);
  return found == manifest_->end() ? nullptr : &found->second;
}

bool FileSet::has(const std::string& name) const {
  std::error_code ignored;  // a file that cannot be looked for cannot be read
  return manifest_ ? entry(name) != nullptr : fs::exists(path(name), ignored);
}

std::optional<std::string> FileSet::as_written(const std::string& name, const ManifestEntry& entry,
                                               uint64_t max_bytes) const {
  // Looks at the place twice: meanwhile a writer may have moved the file there.
  for (const std::string& at : {path(name), staged_folder(folder_) + "/" + name, path(name)})
    if (std::optional<std::string> content = content_of(at, entry, max_bytes)) return content;
  return std::nullopt;
}

std::string FileSet::read(const std::string& name, uint64_t max_bytes) const {
  if (!manifest_) {
    std::string content = read_regular_file(path(name), max_bytes);
    if (fs::exists(path(kManifest)))
      throw BrokenSet(path(name), "file", "one of a set that was written meanwhile", "the folder as it was");
    return content;
  }
  const ManifestEntry* const named = entry(name);
  if (!named) throw BrokenSet(path(name), "file", "none that manifest.json names", "a file of the set");
  if (std::optional<std::string> content = as_written(name, *named, max_bytes)) return *std::move(content);
  refuse(name);
}

FileSet::Found FileSet::find(const std::string& name, uint64_t max_bytes) const {
  const ManifestEntry* const named = entry(name);
  if (named)
    if (std::optional<std::string> content = as_written(name, *named, max_bytes))
      return {*std::move(content), false};
  return {read_regular_file(path(name), max_bytes), named != nullptr};
}

void FileSet::refuse(const std::string& name) const {
  const ManifestEntry named = manifest_->at(name);
  throw BrokenSet(path(name), "content", "a missing, changed or damaged file",
                  fmt::format("{} bytes of hash {}, as manifest.json says", named.bytes, named.hash));
}

FolderLock::FolderLock(const std::string& folder)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  const auto end = std::chrono::steady_clock::now() + kLockWait;
  while (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    if (std::chrono::steady_clock::now() > end) {
      ::close(descriptor_);
      throw Error(folder, "folder", fmt::format("one that another process has written into for {}", kLockWait),
                  "a folder of its own");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

WholeFiles::WholeFiles(const std::string& folder) : folder_((make_folders(folder), folder)), lock_(folder) {
  const std::optional<Manifest> older = own_manifest(folder_);
  finish_write(folder_, older);
  if (older) manifest_ = *older;
}

WholeFiles::~WholeFiles() {
  std::error_code ignored;
  if (!is_committed_) fs::remove_all(staged_folder(folder_), ignored);
}

void WholeFiles::add(const std::string& name, std::string_view content, mode_t mode) {
  if (name == kManifest) throw Error(folder_, "file name", name, "another: that is the manifest's");
  const std::string place = place_within(folder_, name);
  write_new_file(staged_folder(folder_) + "/" + name, content, file_in_place(place), mode, place);
  manifest_[name] = {content.size(), hash_text(content)};
  added_.push_back(name);
  std::erase(removed_, name);
  mode_ &= mode;
}

void WholeFiles::remove(const std::string& name) {
  place_within(folder_, name);
  manifest_.erase(name);
  removed_.push_back(name);
}

void WholeFiles::commit() {
  const std::string staged = staged_folder(folder_), manifest = folder_ + "/" + kManifest;
  // Before the manifest, since afterwards an error could only be reported.
  for (const std::string& needed : folders_of(folder_, added_)) make_folders(needed);
  const std::string text = manifest_json(manifest_);
  std::string lines = hash_text(text) + "\n";
  for (const std::string& name : removed_) lines += name + "\n";
  write_new_file(staged + "/" + kRemoved, lines, std::nullopt, mode_, manifest);
  write_new_file(staged + "/" + kManifest, text, file_in_place(manifest), mode_, manifest);
  for (const std::string& changed : folders_of(staged, added_)) sync_folder(changed);
  if (std::rename((staged + "/" + kManifest).c_str(), manifest.c_str()) != 0)
    throw Error(manifest, "file", std::strerror(errno), "a file that can be replaced");
  is_committed_ = true;  // from here on the staged files are the set, even if a step fails
  sync_folder(folder_);
  place_files(folder_, added_, removed_);
}

}  // namespace glovebench
