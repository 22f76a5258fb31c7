#include "core/database/database_file.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/excerpt.h"
#include "core/base/hash.h"
#include "core/base/name.h"
#include "core/base/parse_json.h"
#include "core/database/field_rows.h"
#include "core/database/packed_labels.h"
#include "core/database/tiny_image.h"
#include "core/database/view_sphere.h"

namespace glovebench {
namespace {

using nlohmann::json;

static_assert(kDatabaseVersion == 3);
constexpr std::string_view kMagic = "glovebench-database-3\n";
constexpr size_t kHashLength = 32;
constexpr size_t kHeaderBegin = kMagic.size() + sizeof(uint64_t) + kHashLength;
constexpr uint64_t kMaxHeader = 256 << 20;  // of 100 million entries: 70 MB
constexpr uint64_t kPage = 4096;
constexpr uint64_t kChunk = 16 << 20;

uint64_t whole_pages(uint64_t bytes) {
  return (bytes + kPage - 1) / kPage * kPage;
}

json postures_to_json(const PostureSet& set) {
  json postures = json::array();
  for (size_t p = 0; p < set.postures.size(); ++p) {
    const Posture& angles = set.postures[p];
    postures.push_back({{"name", set.posture_names[p]},
                        {"angles_rad", std::vector<double>(angles.data(), angles.data() + kAngleCount)}});
  }
  return postures;
}

/// Throws json::exception for what has another shape, Error naming `path` for what no database has. What else
/// `seal` does not write is for the caller to find.
DatabaseHeader header_from_json(const json& text, const std::string& path) {
  DatabaseHeader header;
  header.postures.name = checked_name(text.at("name"), path, "name");
  header.hash = text.at("hash");
  header.side = text.at("side") == "right" ? Side::right : Side::left;
  const std::string memory = text.at("memory");
  const auto known = database_memory_from_string(memory);
  if (!known) throw Error(path, "memory", quoted_excerpt(memory), "\"normal\" or \"low\"");
  header.memory = *known;
  header.field_cap_share = text.at("field_cap_share");
  if (!(header.field_cap_share > 0 && header.field_cap_share <= 1)) {
    throw Error(path, "field_cap_share", fmt::format("{}", header.field_cap_share), "(0, 1]");
  }
  for (const json& posture : text.at("postures")) {
    header.postures.posture_names.push_back(checked_name(posture.at("name"), path, "name of a posture"));
    const std::vector<double> angles = posture.at("angles_rad");
    if (angles.size() != kAngleCount) {
      throw Error(path, "angles_rad", fmt::format("{} angles", angles.size()), fmt::format("{}", kAngleCount));
    }
    header.postures.postures.push_back(Eigen::Map<const Posture>(angles.data()));
  }
  for (const int px : text.at("sizes_px")) {
    if (px < kSmallestTinySize || px > kLargestTinySize) {
      throw Error(path, "tiny images", fmt::format("{} px", px),
                  fmt::format("{} to {} px", kSmallestTinySize, kLargestTinySize));
    }
    header.sizes_px.insert(px);
  }
  if (header.postures.postures.empty()) throw Error(path, "postures", "none", "at least one");
  return header;
}

std::string hash_of(std::span<const uint8_t> bytes) {
  return hash_bytes(std::as_bytes(bytes));
}

}  // namespace

DatabaseLayout::DatabaseLayout(DatabaseHeader header) : header_(std::move(header)) {
  place(0);  // the number of checksums, and with it the header's length, does not depend on the place
  const uint64_t length =
      header_text(std::vector<std::string>(chunks().size(), std::string(kHashLength, '0'))).size();
  place(kHeaderBegin + length);
}

DatabaseLayout::DatabaseLayout(std::span<const uint8_t> file, const std::string& path) {
  const auto text_at = [&](size_t offset, size_t count, const std::string& what) {
    if (offset + count > file.size()) {
      throw Error(path, what, fmt::format("a file of {} bytes", file.size()), "a complete file");
    }
    return std::string(reinterpret_cast<const char*>(file.data()) + offset, count);
  };
  const std::string magic = text_at(0, std::min(kMagic.size(), file.size()), "magic");
  if (magic != kMagic)
    throw Error(path, "magic", "another format", std::string(kMagic.substr(0, kMagic.size() - 1)));
  uint64_t length = 0;
  std::memcpy(&length, text_at(kMagic.size(), sizeof(length), "header length").data(), sizeof(length));
  if (length > kMaxHeader) throw Error(path, "header length", fmt::format("{} bytes", length), "at most 256 MiB");
  const std::string checksum = text_at(kMagic.size() + sizeof(length), kHashLength, "header checksum");
  const std::string text = text_at(kHeaderBegin, length, "header");
  if (hash_text(text) != checksum) throw Error(path, "header checksum", hash_text(text), checksum);

  try {
    const json parsed = parse_json(text, path);
    header_ = header_from_json(parsed, path);
    checksums_ = parsed.at("checksums").get<std::vector<std::string>>();
  } catch (const json::exception& e) {
    throw Error(path, "header", e.what(), "what a database of this version says");
  }
  place(kHeaderBegin + length);
  if (bytes_ != file.size()) {
    throw Error(path, "length", fmt::format("{} bytes", file.size()), fmt::format("{} bytes", bytes_));
  }
  if (checksums_.size() != chunks().size()) {
    throw Error(path, "checksums", fmt::format("{}", checksums_.size()), fmt::format("{}", chunks().size()));
  }
  if (header_text(checksums_) != text)
    throw Error(path, "header", "another text", header_text(checksums_).substr(0, 60));
}

void DatabaseLayout::place(uint64_t header_bytes) {
  const uint64_t entries = header_.postures.postures.size() * kViewCount;
  if (entries > std::numeric_limits<int>::max()) {
    throw Error(header_.postures.name, "views", fmt::format("{}", entries), "at most 2147483647");
  }
  uint64_t end = whole_pages(header_bytes);
  const auto next = [&](uint64_t bytes) {
    const Section section{end, bytes};
    end = whole_pages(end + bytes + kBehind);
    return section;
  };
  box_rays_ = next(entries * sizeof(Eigen::Vector3d));
  for (const int size : header_.sizes_px) {
    const uint64_t pixels = static_cast<uint64_t>(size) * size;
    SizeSections& sections = sizes_[size];
    sections.labels = next(entries * packed_bytes(pixels));
    if (header_.memory == DatabaseMemory::normal) sections.fields = next(entries * pixels * kColorCount);
    sections.rows = next(FieldRows(size, header_.memory, static_cast<int>(entries)).bytes());
  }
  bytes_ = end;
}

std::vector<DatabaseLayout::Chunk> DatabaseLayout::chunks() const {
  std::vector<Chunk> chunks;
  // With the zeros behind it: every byte of the file is in a checksum.
  const auto add = [&](const std::string& name, int size, const Section& section) {
    const uint64_t end = whole_pages(section.offset + section.bytes + kBehind);
    for (uint64_t offset = section.offset; offset < end; offset += kChunk)
      chunks.push_back({name, size, offset, std::min(kChunk, end - offset)});
  };
  add("box_rays", 0, box_rays_);
  for (const auto& [size, sections] : sizes_) {
    add(fmt::format("labels_{}", size), size, sections.labels);
    if (sections.fields.bytes > 0) add(fmt::format("fields_{}", size), size, sections.fields);
    add(fmt::format("rows_{}", size), size, sections.rows);
  }
  return chunks;
}

std::string DatabaseLayout::header_text(const std::vector<std::string>& checksums) const {
  std::string text = json{
      {"name", header_.postures.name},
      {"hash", header_.hash},
      {"side", header_.side == Side::right ? "right" : "left"},
      {"memory", to_string(header_.memory)},
      {"field_cap_share", header_.field_cap_share},
      {"postures", postures_to_json(header_.postures)},
      {"sizes_px", header_.sizes_px},
      {"checksums",
       checksums}}.dump();
  text.resize(whole_pages(kHeaderBegin + text.size()) - kHeaderBegin, ' ');
  return text;
}

void DatabaseLayout::seal(MappedMemory& file) const {
  const std::vector<Chunk> all = chunks();
  std::vector<std::string> checksums(all.size());
  tbb::parallel_for(size_t{0}, all.size(), [&](size_t i) {
    checksums[i] = hash_of(file.bytes().subspan(all[i].offset, all[i].bytes));
    file.release(all[i].offset, all[i].bytes);
  });
  const std::string text = header_text(checksums);
  const uint64_t length = text.size();
  std::string header(kMagic);
  header.append(reinterpret_cast<const char*>(&length), sizeof(length));
  header += hash_text(text) + text;
  std::memcpy(file.writable().data(), header.data(), header.size());
}

void DatabaseLayout::check_sections(const MappedMemory& file, const std::string& path,
                                    std::span<const int> sizes_px) const {
  const std::vector<Chunk> all = chunks();
  tbb::parallel_for(size_t{0}, all.size(), [&](size_t i) {
    const int size = all[i].size_px;
    if (size != 0 && std::ranges::find(sizes_px, size) == sizes_px.end()) return;
    const std::string found = hash_of(file.bytes().subspan(all[i].offset, all[i].bytes));
    if (header_.memory == DatabaseMemory::low) file.release(all[i].offset, all[i].bytes);
    if (found != checksums_[i]) throw Error(path, all[i].section + " checksum", found, checksums_[i]);
  });
}

}  // namespace glovebench
