// The file of a database: magic, length and checksum of a JSON header, the header, then the sections that it lists,
// each with its checksum. Everything is little-endian.
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/base/hash.h"
#include "core/database/database.h"

namespace glovebench {
namespace {

using nlohmann::json;

constexpr std::string_view kMagic = "glovebench-database-1\n";
constexpr size_t kHashLength = 32;
constexpr uint64_t kMaxHeader = 64 << 20;

template <typename Values>
std::string_view bytes_of(const Values& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0])};
}

/// Reads a database file piece by piece and says what is wrong with it.
class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path), in_(path, std::ios::binary) {
    if (!in_) throw Error(path, "file", std::strerror(errno), "a database file");
    std::error_code error;  // a folder opens, too
    size_ = std::filesystem::file_size(path, error);
    if (error) throw Error(path, "file", error.message(), "a database file");
  }
  void fill(void* target, uint64_t count, const std::string& what) {
    in_.read(static_cast<char*>(target), static_cast<std::streamsize>(count));
    if (static_cast<uint64_t>(in_.gcount()) != count) {
      throw Error(path_, what, fmt::format("{} of {} bytes", in_.gcount(), count), "a complete file");
    }
  }
  std::string text(uint64_t count, const std::string& what) {
    if (count > size_) throw Error(path_, what, fmt::format("a length of {} bytes", count), "a complete file");
    std::string result(count, '\0');
    fill(result.data(), count, what);
    return result;
  }
  void seek(uint64_t offset) { in_.seekg(static_cast<std::streamoff>(offset)); }
  uint64_t position() { return static_cast<uint64_t>(in_.tellg()); }
  uint64_t size() const { return size_; }

 private:
  std::string path_;
  std::ifstream in_;
  uint64_t size_ = 0;
};

json read_header(Reader& reader, const std::string& path) {
  const std::string magic = reader.text(std::min<uint64_t>(kMagic.size(), reader.size()), "magic");
  if (magic != kMagic) throw Error(path, "magic", "another format", "glovebench-database-1");
  uint64_t length = 0;
  reader.fill(&length, sizeof(length), "header length");
  if (length > kMaxHeader) throw Error(path, "header length", fmt::format("{} bytes", length), "at most 64 MiB");
  const std::string checksum = reader.text(kHashLength, "header checksum");
  const std::string header = reader.text(length, "header");
  if (hash_text(header) != checksum) throw Error(path, "header checksum", hash_text(header), checksum);
  return json::parse(header);  // intact, so it is what `save` wrote
}

json posture_header(const PostureSet& set) {
  json postures = json::array();
  for (size_t p = 0; p < set.postures.size(); ++p) {
    const Posture& angles = set.postures[p];
    postures.push_back({{"name", set.posture_names[p]},
                        {"angles_rad", std::vector<double>(angles.data(), angles.data() + kAngleCount)}});
  }
  return postures;
}

}  // namespace

void Database::save(const std::string& path) const {
  json sections = json::array();
  std::vector<std::string_view> contents;
  const auto add = [&](const std::string& name, std::string_view content) {
    sections.push_back({{"name", name}, {"bytes", content.size()}, {"checksum", hash_text(content)}});
    contents.push_back(content);
  };
  add("box_rays", bytes_of(box_rays_));
  for (const auto& [size, size_data] : sizes_) {
    add(fmt::format("labels_{}", size), bytes_of(size_data.labels));
    add(fmt::format("fields_{}", size), bytes_of(size_data.fields).substr(0, size_data.fields.size() - kBehind));
  }
  const json header = {{"name", postures_.name},
                       {"hash", hash_},
                       {"side", side_ == Side::right ? "right" : "left"},
                       {"postures", posture_header(postures_)},
                       {"sections", sections}};
  const std::string text = header.dump();
  const uint64_t length = text.size();

  WholeFile file(path);
  file.append(kMagic);
  file.append({reinterpret_cast<const char*>(&length), sizeof(length)});
  file.append(hash_text(text));
  file.append(text);
  for (const std::string_view content : contents) file.append(content);
  file.commit();
}

Database Database::load(const std::string& path, std::span<const int> sizes) {
  Reader reader(path);
  const json header = read_header(reader, path);
  Database database;
  database.postures_.name = header.at("name");
  database.hash_ = header.at("hash");
  database.side_ = header.at("side") == "right" ? Side::right : Side::left;
  for (const json& posture : header.at("postures")) {
    database.postures_.posture_names.push_back(posture.at("name"));
    const std::vector<double> angles = posture.at("angles_rad");
    database.postures_.postures.push_back(Eigen::Map<const Posture>(angles.data()));
  }
  const auto wanted = [&](const std::string& name, int& size) {
    for (const int s : sizes) {
      if (name == fmt::format("labels_{}", s) || name == fmt::format("fields_{}", s)) return size = s, true;
    }
    return false;
  };
  uint64_t offset = reader.position();
  for (const json& section : header.at("sections")) {
    const std::string name = section.at("name");
    const uint64_t bytes = section.at("bytes");
    if (offset + bytes > reader.size()) {
      throw Error(path, name, fmt::format("a file of {} bytes", reader.size()), "a complete file");
    }
    reader.seek(offset);
    offset += bytes;
    int size = 0;
    std::string_view content;
    if (name == "box_rays") {
      database.box_rays_.resize(bytes / sizeof(Eigen::Vector3d));
      reader.fill(database.box_rays_.data(), bytes, name);
      content = bytes_of(database.box_rays_);
    } else if (wanted(name, size)) {
      SizeData& data = database.sizes_[size];
      uint8_t* target = nullptr;
      if (name.starts_with("labels")) {
        data.labels.resize(bytes);
        target = data.labels.data();
      } else {
        data.fields.resize(bytes + kBehind);
        target = data.fields.data();
      }
      reader.fill(target, bytes, name);
      content = {reinterpret_cast<const char*>(target), bytes};
    } else {
      continue;
    }
    const std::string checksum = section.at("checksum");
    if (hash_text(content) != checksum) throw Error(path, name + " checksum", hash_text(content), checksum);
  }
  if (offset != reader.size()) {
    throw Error(path, "length", fmt::format("{} bytes", reader.size()), fmt::format("{} bytes", offset));
  }
  database.arrange_rows();
  return database;
}

}  // namespace glovebench
