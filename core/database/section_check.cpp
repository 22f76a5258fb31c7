#include "core/database/section_check.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>

#include "core/base/hash.h"
#include "core/database/database.h"
#include "core/database/tiny_image.h"

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
      break;
  }
  return {"a larger distance", fmt::format("at most {}", field_cap(field_cap_share, section.size_px))};
}

constexpr size_t kPieceEntries = DatabaseLayout::kPieceEntries;

/// A piece of a section that the file holds.
std::span<const uint8_t> piece_of(const MappedMemory& file, const Section& section, size_t piece) {
  return file.bytes().subspan(section.offset + piece * section.piece_bytes, section.piece_bytes);
}

/// A piece of the fields that a low-memory database does not hold, in `made`.
std::span<const uint8_t> make_fields(const DatabaseLayout& layout, const MappedMemory& file, int size, size_t piece,
                                     std::vector<uint8_t>& made) {
  const SizeSections& sections = layout.sizes().at(size);
  const std::span<const uint8_t> labels = piece_of(file, sections.labels, piece);
  made.resize(sections.fields.piece_bytes);
  const size_t packed = labels.size() / kPieceEntries, bytes = made.size() / kPieceEntries;
  for (size_t i = 0; i < kPieceEntries; ++i)
    chamfer_fields(unpack_labels(labels.subspan(i * packed, packed), size, size),
                   field_cap(layout.header().field_cap_share, size), std::span(made).subspan(i * bytes, bytes));
  return made;
}

/// What a pass found in a piece of a section.
struct PieceContent {
  std::string hash;
  bool has_fault = false;
};

}  // namespace

DatabaseContent look_at_sections(const DatabaseLayout& layout, const MappedMemory& file,
                                 std::span<const Section> sections, bool load) {
  const DatabaseHeader& header = layout.header();
  const double cap_share = header.field_cap_share;
  const bool release = !load || header.memory == DatabaseMemory::low;
  const size_t piece_count = static_cast<size_t>(layout.entry_count()) / kPieceEntries;
  DatabaseContent content{std::vector<SectionContent>(sections.size()), {}};
  for (const Section& section : sections)
    if (load && section.kind == Section::Kind::fields)
      content.rows.try_emplace(section.size_px, section.size_px, header.memory, layout.entry_count(),
                               field_cap(cap_share, section.size_px));

  std::vector<std::vector<PieceContent>> found(sections.size(), std::vector<PieceContent>(piece_count));
  tbb::enumerable_thread_specific<std::vector<uint8_t>> made_fields;
  tbb::parallel_for(size_t{0}, piece_count, [&](size_t piece) {
    for (size_t s = 0; s < sections.size(); ++s) {
      const Section& section = sections[s];
      const std::span<const uint8_t> bytes =
          section.bytes > 0 ? piece_of(file, section, piece)
                            : make_fields(layout, file, section.size_px, piece, made_fields.local());
      found[s][piece] = {hash_bytes(std::as_bytes(bytes)), !has_values_of(section, bytes, cap_share)};
      if (load && section.kind == Section::Kind::fields)
        content.rows.at(section.size_px).put(static_cast<int>(piece * kPieceEntries), bytes);
    }
    if (!release) return;
    for (const Section& section : sections)
      if (section.bytes > 0) file.release(section.offset + piece * section.piece_bytes, section.piece_bytes);
  });

  for (size_t s = 0; s < sections.size(); ++s) {
    std::string hashes;
    for (const PieceContent& piece : found[s]) {
      hashes += piece.hash;
      if (piece.has_fault) content.sections[s].fault = fault_of(sections[s], cap_share);
    }
    content.sections[s].hash = hash_text(hashes);
  }
  return content;
}

}  // namespace glovebench
