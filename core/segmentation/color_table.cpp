#include "core/segmentation/color_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/image.h"
#include "core/base/input_file.h"
#include "core/base/text.h"
#include "core/base/whole_file.h"

namespace glovebench {
namespace {

// File: this line with the space ("yuv" or "rgb") at its end, the hash of the labels (32 hexadecimal digits) and a
// line feed, then one byte a cell.
constexpr std::string_view kTableMagic = "glovebench color table, version ";
constexpr std::string_view kTableVersion = "2, ";
constexpr size_t kSpaceLength = 3;
constexpr size_t kTableHashLength = 32;
constexpr size_t kHeaderLength =
    kTableMagic.size() + kTableVersion.size() + kSpaceLength + 1 + kTableHashLength + 1;

constexpr uint8_t kOutside = kColorCount + 1;  // pads the label image; has no vote

/// A label image with a margin of one pixel.
class PaddedLabels {
 public:
  explicit PaddedLabels(const LabelImage& labels)
      : stride_(labels.width() + 2), pixels_(size_t(stride_) * (labels.height() + 2), kOutside) {
    for (int v = 0; v < labels.height(); ++v)
      std::copy_n(labels.data() + size_t(v) * labels.width(), labels.width(),
                  &pixels_[size_t(v + 1) * stride_ + 1]);
  }
  /// The upper left of the neighborhood of pixel (0, v).
  const uint8_t* row(int v) const { return &pixels_[size_t(v) * stride_]; }
  int stride() const { return stride_; }

 private:
  int stride_;
  RecycledVector<uint8_t> pixels_;
};

uint64_t load_eight(const uint8_t* bytes) {
  uint64_t word;
  std::memcpy(&word, bytes, sizeof word);
  return word;
}

/// Of the eight pixels whose neighborhoods begin at `corner`, how many come before the first that differs from a
/// neighbor.
int uniform_pixels(const uint8_t* corner, int stride) {
  const uint64_t center = load_eight(corner + stride + 1);
  uint64_t difference = 0;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) difference |= center ^ load_eight(corner + row * stride + column);
  static_assert(std::endian::native == std::endian::little, "the first pixel is in the lowest byte");
  return std::countr_zero(difference) / 8;
}

/// Gives each pixel `answer(u, v, corner, stride)`, which must be the pixel's own label if all neighbors have it.
template <typename Answer>
LabelImage filter_3x3(const LabelImage& labels, const Answer& answer) {
  const PaddedLabels padded(labels);
  LabelImage filtered = labels;
  for (int v = 0; v < labels.height(); ++v) {
    const uint8_t* row = padded.row(v);
    for (int u = 0; u < labels.width();) {
      // Most of an image is uniform; eight such pixels cost nine reads.
      const int uniform = u + 8 <= labels.width() ? uniform_pixels(row + u, padded.stride()) : 0;
      u += uniform;
      if (uniform == 8) continue;
      filtered(u, v) = answer(u, v, row + u, padded.stride());
      ++u;
    }
  }
  return filtered;
}

uint8_t majority(const uint8_t* corner, int stride) {
  std::array<uint8_t, kOutside + 1> votes{};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) ++votes[corner[row * stride + column]];
  uint8_t best = corner[stride + 1];
  for (uint8_t label = 0; label <= kColorCount; ++label)
    if (votes[label] > votes[best]) best = label;
  return best;
}

template <ColorSpace kSpace>
LabelImage labels_of(const RegisteredImage& mapped, const uint8_t* cells) {
  LabelImage labels(mapped.color.width(), mapped.color.height());
  for (int v = 0; v < labels.height(); ++v) {
    const Rgb* const colors = mapped.color.row(v);
    uint8_t* const found = labels.row(v);
    for_each_nonzero(mapped.has_color, v,
                     [&](int u) { found[u] = cells[ColorTable::cell_of_rgb(colors[u], kSpace)]; });
  }
  return labels;
}

template <ColorSpace kSpace>
LabelImage labels_of(const ColorImage& color, const uint8_t* cells) {
  LabelImage labels(color.width(), color.height());
  std::transform(color.begin(), color.end(), labels.begin(),
                 [&](const Rgb& rgb) { return cells[ColorTable::cell_of_rgb(rgb, kSpace)]; });
  return labels;
}

/// What the table's space asks for is decided before the loop over the pixels. `ColorTable` has a cell for each
/// color, so that none needs a check.
template <typename ImageType>
LabelImage labels_of(const ImageType& image, const ColorTable& table) {
  return table.space() == ColorSpace::yuv ? labels_of<ColorSpace::yuv>(image, table.labels().data())
                                          : labels_of<ColorSpace::rgb>(image, table.labels().data());
}

constexpr int kFewestVotes = 2;  // of a pixel without a label: one alone may be a speck

using Votes = std::array<int, kColorCount + 1>;

/// Counts labels in a pixel's neighborhood that begins at `corner`, on its surface; index 0 counts all.
Votes votes_at(const uint8_t* corner, int stride, const DepthImage& depth, int u, int v, double depth_step) {
  Votes votes{};
  const double z = depth(u, v);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const uint8_t label = corner[row * stride + column];
      if (label == 0 || label == kOutside) continue;
      if (std::abs(static_cast<double>(depth(u + column - 1, v + row - 1)) - z) >= depth_step) continue;
      ++votes[label];
      ++votes[0];
    }
  }
  return votes;
}

uint8_t winner(const Votes& votes, uint8_t own) {
  if (own == 0 && votes[0] < kFewestVotes) return 0;
  uint8_t best = own;
  for (uint8_t label = 1; label <= kColorCount; ++label)
    if (votes[label] > (best == 0 ? 0 : votes[best])) best = label;
  return best;
}

}  // namespace

ColorTable::ColorTable(std::vector<uint8_t> labels, ColorSpace space) : labels_(std::move(labels)), space_(space) {
  if (labels_.size() != kCells)
    throw Error("color table", "cells", std::to_string(labels_.size()), std::to_string(kCells));
  const auto wrong = std::find_if(labels_.begin(), labels_.end(), [](uint8_t l) { return l > kColorCount; });
  if (wrong != labels_.end())
    throw Error("color table", "cell " + std::to_string(wrong - labels_.begin()), std::to_string(*wrong),
                "a label of 0.." + std::to_string(kColorCount));
}

void ColorTable::save(const std::string& path) const {
  const std::string cells(labels_.begin(), labels_.end());
  write_file(path, std::string(kTableMagic) + std::string(kTableVersion) + std::string(to_string(space_)) + "\n" +
                       hash_text(cells) + "\n" + cells);
}

ColorTable ColorTable::load(const std::string& path) {
  return color_table_from_bytes(read_file(path, 2 * (kHeaderLength + kCells)), path);
}

ColorTable color_table_from_bytes(std::string_view bytes, const std::string& where) {
  if (!bytes.starts_with(kTableMagic)) throw Error(where, "header", "something else", "a color table");
  const std::string_view version = bytes.substr(kTableMagic.size());
  if (!version.starts_with(kTableVersion))
    throw Error(where, "version", "\"" + printable(version.substr(0, version.find('\n')).substr(0, 20)) + "\"",
                "2");
  if (bytes.size() != kHeaderLength + ColorTable::kCells)
    throw Error(where, "size", std::to_string(bytes.size()) + " bytes",
                std::to_string(kHeaderLength + ColorTable::kCells) + " bytes");
  const std::string_view space_text = version.substr(kTableVersion.size(), kSpaceLength);
  const std::optional<ColorSpace> space = from_name<ColorSpace>(space_text);
  if (!space || version[kTableVersion.size() + kSpaceLength] != '\n')
    throw Error(where, "color space", "\"" + printable(space_text) + "\"", known_names<ColorSpace>());
  const std::string_view cells = bytes.substr(kHeaderLength);
  const std::string expected = hash_text(cells) + "\n";
  const std::string_view found = bytes.substr(kHeaderLength - kTableHashLength - 1, kTableHashLength + 1);
  if (found != expected) throw Error(where, "checksum", "another one", "that of the cells");
  return ColorTable(std::vector<uint8_t>(cells.begin(), cells.end()), *space);
}

LabelImage segment(const RegisteredImage& mapped, const ColorTable& table) { return labels_of(mapped, table); }

LabelImage segment(const ColorImage& color, const ColorTable& table) { return labels_of(color, table); }

LabelImage majority_filter(const LabelImage& labels) {
  return filter_3x3(labels, [](int, int, const uint8_t* corner, int stride) { return majority(corner, stride); });
}

LabelImage surface_majority(const LabelImage& labels, const DepthImage& depth, double depth_step) {
  check(labels.width() == depth.width() && labels.height() == depth.height(), "labels and depth are of one camera");
  return filter_3x3(labels, [&](int u, int v, const uint8_t* corner, int stride) {
    const uint8_t own = corner[stride + 1];
    return depth(u, v) > 0 ? winner(votes_at(corner, stride, depth, u, v, depth_step), own) : own;
  });
}

}  // namespace glovebench
