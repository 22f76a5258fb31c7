#include "core/database/database_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <algorithm>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "core/database/section_check.h"
#include "core/database/tiny_image.h"

namespace glovebench {
namespace {

using nlohmann::json;

static_assert(kDatabaseVersion == 5);
constexpr std::string_view kDatabaseMagic = "glovebench-database-5\n", kAnyMagic = "glovebench-database-";
constexpr size_t kDatabaseHashLength = 32;
constexpr size_t kHeaderBegin = kDatabaseMagic.size() + sizeof(uint64_t) + kDatabaseHashLength;
constexpr uint64_t kMaxHeader = 256 << 20;  // of 100 million entries: 70 MB
constexpr uint64_t kPage = 4096;

uint64_t whole_pages(uint64_t bytes) { return (bytes + kPage - 1) / kPage * kPage; }

json postures_to_json(const PostureSet& set) {
  json postures = json::array();
  for (size_t p = 0; p < set.postures.size(); ++p) {
    const Posture& angles = set.postures[p];
    postures.push_back({{"name", set.posture_names[p]},
                        {"angles_rad", std::vector<double>(angles.data(), angles.data() + kAngleCount)}});
  }
  return postures;
}

Posture posture_from(const JsonCursor& angles_rad) {
  const JsonItems angles = angles_rad.items(kAngleCount);
  Posture posture;
  for (int a = 0; a < kAngleCount; ++a) posture[a] = angles[a].number();
  // Rounding between degrees and radians may move an angle across its limit.
  if (constexpr double kRounding = 1e-9; !(posture - clamp_to_limits(posture)).isZero(kRounding))
    angles_rad.fail("an angle that no hand has", "angles within the limits of a hand");
  return posture;
}

/// The caller checks the rest.
DatabaseHeader header_from(const JsonCursor& root, const std::string& path) {
  DatabaseHeader header;
  header.postures.name = root["name"].name();
  header.input_hash = root["input_hash"].text();
  header.side = root["side"].one_of<Side>();
  header.memory = root["memory"].one_of<DatabaseMemory>();
  const JsonCursor cap = root["field_cap_share"];
  header.field_cap_share = cap.number();
  if (!(header.field_cap_share > 0 && header.field_cap_share <= 1)) cap.fail("(0, 1]");
  for (const JsonCursor& posture : root["postures"].some_items()) {
    header.postures.posture_names.push_back(posture["name"].name());
    header.postures.postures.push_back(posture_from(posture["angles_rad"]));
  }
  for (const JsonCursor& px : root["sizes_px"].items())
    header.sizes_px.insert(static_cast<int>(px.integer(kSmallestTinySize, kLargestTinySize)));
  const std::vector<std::string>& names = header.postures.posture_names;
  if (std::set<std::string>(names.begin(), names.end()).size() != names.size())
    throw Error(path, "names of postures", "one twice", "names that differ");
  return header;
}

/// All bytes behind a section up to the next one.
std::span<const uint8_t> behind(const MappedMemory& file, const Section& section) {
  const uint64_t end = section.offset + section.bytes;
  return file.bytes().subspan(end, whole_pages(end + DatabaseLayout::kBehind) - end);
}

}  // namespace

std::string Section::name() const {
  switch (kind) {
    case Kind::box_rays:
      return "box_rays";
    case Kind::labels:
      return fmt::format("labels_{}", size_px);
    case Kind::fields:
      break;
  }
  return fmt::format("fields_{}", size_px);
}

DatabaseLayout::DatabaseLayout(DatabaseHeader header) : header_(std::move(header)) {
  place(0);  // the hashes' number, and with it the header's length, does not depend on the place
  for (const Section& section : sections()) hashes_[section.name()] = std::string(kDatabaseHashLength, '0');
  place(kHeaderBegin + header_text().size());
}

DatabaseLayout::DatabaseLayout(std::span<const uint8_t> file, const std::string& path) {
  const auto text_at = [&](size_t offset, size_t count, const std::string& what) {
    if (offset + count > file.size())
      throw Error(path, what, fmt::format("a file of {} bytes", file.size()), "a complete file");
    return std::string(reinterpret_cast<const char*>(file.data()) + offset, count);
  };
  const std::string magic = text_at(0, std::min(kDatabaseMagic.size(), file.size()), "magic");
  if (magic != kDatabaseMagic) {
    throw Error(
        path, "magic", magic.starts_with(kAnyMagic) ? "a database of another version" : "another format",
        fmt::format("{} (glovebench db build makes one)", kDatabaseMagic.substr(0, kDatabaseMagic.size() - 1)));
  }
  uint64_t length = 0;
  std::memcpy(&length, text_at(kDatabaseMagic.size(), sizeof(length), "header length").data(), sizeof(length));
  if (length > kMaxHeader) throw Error(path, "header length", fmt::format("{} bytes", length), "at most 256 MiB");
  const std::string checksum =
      text_at(kDatabaseMagic.size() + sizeof(length), kDatabaseHashLength, "header checksum");
  const std::string text = text_at(kHeaderBegin, length, "header");
  if (hash_text(text) != checksum) throw Error(path, "header checksum", hash_text(text), checksum);

  const json parsed = parse_json(text, path);
  const JsonCursor root(parsed, path);
  header_ = header_from(root, path);
  for (const auto& [name, hash] : root["hashes"].members()) hashes_[name] = hash.text();
  place(kHeaderBegin + length);
  if (bytes_ != file.size())
    throw Error(path, "length", fmt::format("{} bytes", file.size()), fmt::format("{} bytes", bytes_));
  std::set<std::string> names;
  for (const Section& section : sections()) names.insert(section.name());
  if (!std::ranges::equal(names, hashes_, {}, {}, [](const auto& hash) { return hash.first; }))
    throw Error(path, "hashes", "those of other sections", fmt::format("{}", fmt::join(names, ", ")));
  if (header_text() != text) throw Error(path, "header", "another text", header_text().substr(0, 60));
}

void DatabaseLayout::place(uint64_t header_bytes) {
  const uint64_t entries = header_.postures.postures.size() * kViewCount;
  if (entries > std::numeric_limits<int>::max())
    throw Error(header_.postures.name, "views", fmt::format("{}", entries), "at most 2147483647");
  uint64_t end = whole_pages(header_bytes);
  const auto next = [&](Section::Kind kind, int size, uint64_t pieces, uint64_t entry_bytes) {
    const uint64_t piece_bytes = kPieceEntries * entry_bytes;
    const Section section{kind, size, end, pieces * piece_bytes, piece_bytes};
    if (section.bytes > 0) end = whole_pages(end + section.bytes + kBehind);
    return section;
  };
  static_assert(kViewCount % kPieceEntries == 0);
  const uint64_t pieces = entries / kPieceEntries;
  box_rays_ = next(Section::Kind::box_rays, 0, pieces, sizeof(Eigen::Vector3d));
  for (const int size : header_.sizes_px) {
    const uint64_t pixels = static_cast<uint64_t>(size) * size;
    const uint64_t stored = header_.memory == DatabaseMemory::normal ? pieces : 0;
    SizeSections& sections = sizes_[size];
    sections.labels = next(Section::Kind::labels, size, pieces, packed_bytes(pixels));
    sections.fields = next(Section::Kind::fields, size, stored, pixels * kColorCount);
  }
  bytes_ = end;
}

std::vector<Section> DatabaseLayout::sections() const {
  std::vector<Section> sections = {box_rays_};
  for (const auto& [size, of_size] : sizes_) sections.insert(sections.end(), {of_size.labels, of_size.fields});
  return sections;
}

std::string DatabaseLayout::header_text() const {
  std::string text = json{
      {"name", header_.postures.name},
      {"input_hash", header_.input_hash},
      {"side", to_string(header_.side)},
      {"memory", to_string(header_.memory)},
      {"field_cap_share", header_.field_cap_share},
      {"postures", postures_to_json(header_.postures)},
      {"sizes_px", header_.sizes_px},
      {"hashes",
       hashes_}}.dump();
  text.resize(whole_pages(kHeaderBegin + text.size()) - kHeaderBegin, ' ');
  return text;
}

std::string DatabaseLayout::content_hash() const {
  json content = {{"side", to_string(header_.side)}, {"field_cap_share", header_.field_cap_share}};
  for (const Posture& angles : header_.postures.postures)
    content["angles_rad"].push_back(std::vector<double>(angles.begin(), angles.end()));
  content.update(json(hashes_));
  return hash_text(content.dump());
}

void DatabaseLayout::seal(MappedMemory& file) {
  const std::vector<Section> all = sections();
  const std::vector<SectionContent> contents = look_at_sections(*this, file, all, false).sections;
  for (size_t s = 0; s < all.size(); ++s) {
    check(!contents[s].fault, "a database holds what its sections are for");
    hashes_[all[s].name()] = contents[s].hash;
  }
  const std::string text = header_text();
  const uint64_t length = text.size();
  std::string header(kDatabaseMagic);
  header.append(reinterpret_cast<const char*>(&length), sizeof(length));
  header += hash_text(text) + text;
  std::memcpy(file.writable().data(), header.data(), header.size());
}

std::map<int, FieldRows> DatabaseLayout::read_sections(const MappedMemory& file, const std::string& path,
                                                       std::span<const int> sizes_px) const {
  std::vector<Section> wanted = sections();
  std::erase_if(wanted, [&](const Section& section) {
    return section.size_px != 0 && std::ranges::count(sizes_px, section.size_px) == 0;
  });
  auto [contents, rows] = look_at_sections(*this, file, wanted, true);
  for (size_t s = 0; s < wanted.size(); ++s) {
    const std::string name = wanted[s].name(), &expected = hashes_.at(name);
    if (contents[s].hash != expected) throw Error(path, name + " checksum", contents[s].hash, expected);
    if (contents[s].fault) throw Error(path, name, contents[s].fault->first, contents[s].fault->second);
    if (wanted[s].bytes > 0 && std::ranges::any_of(behind(file, wanted[s]), [](uint8_t byte) { return byte != 0; }))
      throw Error(path, "bytes behind " + name, "another value", "0");
  }
  return std::move(rows);
}

}  // namespace glovebench
