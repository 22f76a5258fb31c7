#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_names.h"
#include "core/base/image.h"
#include "core/camera/registration.h"

namespace glovebench {

/// Y, U, V, each 0..255 (BT.601, full range, U and V centered at 128).
using Yuv = std::array<uint8_t, 3>;
constexpr Yuv yuv_from_rgb(const Rgb& rgb) {
  // 16-bit fixed point, rounded (halves down, so that U and V of pure blue and red end at 255 without a clamp).
  constexpr int half = (1 << 15) - 1, center = 128 << 16;
  const int r = rgb[0], g = rgb[1], b = rgb[2];
  return {static_cast<uint8_t>((19595 * r + 38470 * g + 7471 * b + half) >> 16),
          static_cast<uint8_t>((-11059 * r - 21709 * g + 32768 * b + half + center) >> 16),
          static_cast<uint8_t>((32768 * r - 27439 * g - 5329 * b + half + center) >> 16)};
}

/// The axes of a color table: the paper's (Y, U, V), or (R, G, B) to compare it with.
enum class ColorSpace { yuv, rgb };
constexpr auto names_of(ColorSpace) {
  return std::to_array<std::string_view>({"yuv", "rgb"});
}

/// The look-up table of section III-A: 64 x 64 x 64 cells over (Y, U, V), or over (R, G, B), each holding a label
/// 0..10.
class ColorTable {
 public:
  static constexpr int kBits = 6;
  static constexpr size_t kCells = size_t{1} << (3 * kBits);

  ColorTable() : labels_(kCells, 0) {}
  /// Throws Error unless there are kCells labels, all 0..kColorCount.
  explicit ColorTable(std::vector<uint8_t> labels, ColorSpace space = ColorSpace::yuv);

  /// The cell of a color given in the table's own space.
  static size_t cell(const std::array<uint8_t, 3>& color) {
    constexpr int shift = 8 - kBits;
    return (size_t{color[0]} >> shift) << (2 * kBits) | (size_t{color[1]} >> shift) << kBits |
           (size_t{color[2]} >> shift);
  }
  static size_t cell_of_rgb(const Rgb& rgb, ColorSpace space) {
    return cell(space == ColorSpace::yuv ? yuv_from_rgb(rgb) : rgb);
  }
  uint8_t label(const Rgb& rgb) const { return labels_[cell_of_rgb(rgb, space_)]; }
  const std::vector<uint8_t>& labels() const { return labels_; }
  ColorSpace space() const { return space_; }

  /// Versioned, checksummed file. `load` throws Error naming the file and what is wrong with it.
  void save(const std::string& path) const;
  static ColorTable load(const std::string& path);

 private:
  std::vector<uint8_t> labels_;
  ColorSpace space_ = ColorSpace::yuv;
};

/// The labeled image L: the table applied to every pixel of M that has a color.
LabelImage segment(const RegisteredImage& mapped, const ColorTable& table);
/// The table applied to every pixel of a color image.
LabelImage segment(const ColorImage& color, const ColorTable& table);

/// Replaces each label by the majority of its 3x3 neighborhood (a configuration, not in the paper).
LabelImage majority_filter(const LabelImage& labels);

/// The table of what a file of ColorTable::save holds; `where` names it in messages. Throws Error naming the field
/// that is wrong.
ColorTable color_table_from_bytes(std::string_view bytes, const std::string& where);

/// Labels where patches meet and where the hand ends: there a pixel mixes two colors, and a color table says
/// nothing of it, or a third color (not in the paper). Each pixel with a depth takes the label that most of its 3x3
/// neighborhood has, itself included, of those within `depth_step` (m) of its depth; pixels without a label do not
/// vote, its own label wins a tie, else the smallest. A pixel that has none takes one only if two vote. Both images
/// have one size.
LabelImage surface_majority(const LabelImage& labels, const DepthImage& depth, double depth_step = 0.02);

}  // namespace glovebench
