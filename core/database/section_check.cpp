#include "core/database/section_check.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>

#include "core/base/hash.h"
#include "core/database/database.h"

namespace glovebench {
namespace {

/// The largest error of a unit vector's squared length.
constexpr double kRayTolerance = 1e-9;

bool are_rays(std::span<const uint8_t> piece) {
  const std::span rays(reinterpret_cast<const Eigen::Vector3d*>(piece.data()),
                       piece.size() / sizeof(Eigen::Vector3d));
  return std::ranges::all_of(rays, [](const Eigen::Vector3d& ray) {
    return std::abs(ray.squaredNorm() - 1) <= kRayTolerance && ray.z() > 0;  // false for NaN
  });
}

bool are_labels(std::span<const uint8_t> piece) {
  unsigned strange = 0;  // without a branch, so that the loop is vectorized
  for (const uint8_t pair : piece) strange |= ((pair & 15) > kColorCount) | ((pair >> 4) > kColorCount);
  return strange == 0;
}

bool are_distances(std::span<const uint8_t> piece, uint8_t cap) {
  uint8_t largest = 0;
  for (const uint8_t value : piece) largest = std::max(largest, value);
  return largest <= cap;
}

bool has_values_of(const Section& section, std::span<const uint8_t> piece, double field_cap_share) {
  switch (section.kind) {
    case Section::Kind::box_rays:
      return are_rays(piece);
    case Section::Kind::labels:
      return are_labels(piece);
    case Section::Kind::fields:
    case Section::Kind::rows:
      return are_distances(piece, field_cap(field_cap_share, section.size_px));
  }
  return false;
}

std::pair<std::string, std::string> fault_of(const Section& section, double field_cap_share) {
  switch (section.kind) {
    case Section::Kind::box_rays:
      return {"another direction", "unit vectors to what lies before the camera"};
    case Section::Kind::labels:
      return {"another label", fmt::format("0 to {}", kColorCount)};
    case Section::Kind::fields:
    case Section::Kind::rows:
      break;
  }
  return {"a larger distance", fmt::format("at most {}", field_cap(field_cap_share, section.size_px))};
}

/// The part of a section that one thread looks at.
struct Piece {
  size_t section;
  uint64_t offset, bytes;
  std::string hash;
  bool has_fault = false;
};

std::vector<Piece> pieces_of(std::span<const Section> sections) {
  std::vector<Piece> pieces;
  for (size_t s = 0; s < sections.size(); ++s)
    for (uint64_t begin = 0; begin < sections[s].bytes; begin += sections[s].piece_bytes)
      pieces.push_back({s, sections[s].offset + begin, sections[s].piece_bytes, {}});
  return pieces;
}

}  // namespace

std::string piece_hash(std::span<const uint8_t> piece) {
  return hash_bytes(std::as_bytes(piece));
}

std::string section_hash(std::span<const std::string> piece_hashes) {
  std::string text;
  for (const std::string& hash : piece_hashes) text += hash;
  return hash_text(text);
}

std::vector<SectionContent> look_at_sections(const MappedMemory& file, std::span<const Section> sections,
                                             double field_cap_share, bool release) {
  std::vector<Piece> pieces = pieces_of(sections);
  tbb::parallel_for(size_t{0}, pieces.size(), [&](size_t p) {
    Piece& piece = pieces[p];
    const std::span<const uint8_t> bytes = file.bytes().subspan(piece.offset, piece.bytes);
    piece.hash = piece_hash(bytes);
    piece.has_fault = !has_values_of(sections[piece.section], bytes, field_cap_share);
    if (release) file.release(piece.offset, piece.bytes);
  });
  std::vector<std::vector<std::string>> hashes(sections.size());
  std::vector<SectionContent> contents(sections.size());
  for (const Piece& piece : pieces) {
    hashes[piece.section].push_back(piece.hash);
    if (piece.has_fault) contents[piece.section].fault = fault_of(sections[piece.section], field_cap_share);
  }
  for (size_t s = 0; s < sections.size(); ++s) contents[s].hash = section_hash(hashes[s]);
  return contents;
}

}  // namespace glovebench
