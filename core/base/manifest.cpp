#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/excerpt.h"
#include "core/base/file_set.h"
#include "core/base/hash.h"
#include "core/base/input_file.h"
#include "core/base/name.h"
#include "core/base/parse_json.h"
#include "core/base/staged_files.h"

namespace glovebench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFormat = "glovebench-manifest";

ManifestEntry entry_from(const nlohmann::json& json, const std::string& where) {
  ManifestEntry entry{json.at("name"), json.at("bytes"), json.at("hash")};
  path_within(where, entry.name);
  if (json.size() != 3 || !json.at("bytes").is_number_unsigned())
    throw Error(where, "files", excerpt(json), "name, bytes and hash");
  return entry;
}

/// The content of a file, if it is what the manifest says.
std::optional<std::string> content_of(const std::string& path, const ManifestEntry& entry, uint64_t max_bytes) {
  std::error_code error;
  if (fs::file_size(path, error) != entry.bytes || error) return std::nullopt;
  std::string content = read_regular_file(path, max_bytes);
  if (hash_text(content) != entry.hash) return std::nullopt;
  return content;
}

}  // namespace

std::string manifest_json(const Manifest& manifest, uint64_t max_bytes) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ManifestEntry& file : manifest.files)
    list.push_back({{"name", file.name}, {"bytes", file.bytes}, {"hash", file.hash}});
  const nlohmann::ordered_json json = {
      {"format", kFormat}, {"version", 1}, {"kind", manifest.kind}, {"files", std::move(list)}};
  std::string text = json.dump(1) + "\n";
  if (text.size() > max_bytes)
    throw Error(kManifest, "size", fmt::format("{} bytes", text.size()), fmt::format("at most {}", max_bytes));
  return text;
}

Manifest parse_manifest(const std::string& text, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  try {
    if (document.at("format") != kFormat || document.at("version") != 1)
      throw Error(where, "format", excerpt(document.at("format")), "glovebench-manifest, version 1");
    Manifest manifest{document.value("kind", std::string()), {}};
    std::vector<ManifestEntry>& files = manifest.files;
    std::set<std::string> names;
    for (const nlohmann::json& json : document.at("files")) {
      files.push_back(entry_from(json, where));
      if (!names.insert(files.back().name).second)
        throw Error(where, "files", quoted_excerpt(files.back().name) + " twice", "each file once");
    }
    return manifest;
  } catch (const nlohmann::json::exception& e) {
    throw Error(where, "manifest", printable(e.what()),
                "format, version, kind and files with name, bytes and hash");
  }
}

std::optional<Manifest> read_manifest(const std::string& folder) {
  const std::string path = folder + "/" + kManifest;
  std::error_code error;
  const bool is_there = fs::exists(path, error);
  if (error) throw Error(path, "file", error.message(), "a manifest that can be read, or none");
  if (!is_there) return std::nullopt;
  return parse_manifest(read_regular_file(path, kLargestManifest), path);
}

bool FileSet::has(const std::string& name) const {
  if (manifest_) return std::ranges::find(manifest_->files, name, &ManifestEntry::name) != manifest_->files.end();
  std::error_code ignored;  // what cannot be looked for cannot be read
  return fs::exists(path(name), ignored);
}

std::string FileSet::read(const std::string& name, uint64_t max_bytes) const {
  if (!manifest_) return read_regular_file(path(name), max_bytes);
  const auto entry = std::ranges::find(manifest_->files, name, &ManifestEntry::name);
  if (entry == manifest_->files.end())
    throw BrokenSet(path(name), "file", "none that manifest.json names", "a file of the set");
  // The place once more: the writer may have moved the file there since.
  for (const std::string& at : {path(name), staged_path(folder_, name), path(name)})
    if (std::optional<std::string> content = content_of(at, *entry, max_bytes)) return *std::move(content);
  fail(*entry);
}

void FileSet::expect_content(const std::string& name, std::string_view content) const {
  if (!manifest_) return;
  const auto entry = std::ranges::find(manifest_->files, name, &ManifestEntry::name);
  if (entry != manifest_->files.end() && (content.size() != entry->bytes || hash_text(content) != entry->hash))
    fail(*entry);
}

void FileSet::fail(const ManifestEntry& entry) const {
  throw BrokenSet(path(entry.name), "content", "a missing, changed or damaged file",
                  fmt::format("{} bytes of hash {}, as manifest.json says", entry.bytes, entry.hash));
}

}  // namespace glovebench
