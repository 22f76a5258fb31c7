#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/enum_names.h"
#include "core/base/image.h"
#include "core/camera/registration.h"

namespace glovebench {

/// BT.601, full range, U and V centered at 128.
using Yuv = std::array<uint8_t, 3>;
constexpr Yuv yuv_from_rgb(const Rgb& rgb) {
  // 16-bit fixed point. Halves round down: no clamp is needed.
  constexpr int half = (1 << 15) - 1, center = 128 << 16;
  const int r = rgb[0], g = rgb[1], b = rgb[2];
  return {static_cast<uint8_t>((19595 * r + 38470 * g + 7471 * b + half) >> 16),
          static_cast<uint8_t>((-11059 * r - 21709 * g + 32768 * b + half + center) >> 16),
          static_cast<uint8_t>((32768 * r - 27439 * g - 5329 * b + half + center) >> 16)};
}

/// The paper uses YUV.
enum class ColorSpace { yuv, rgb };
constexpr auto names_of(ColorSpace) { return std::to_array<std::string_view>({"yuv", "rgb"}); }

/// Labels of 64x64x64 color cells.
/// Paper: section III-A.
class ColorTable {
 public:
  static constexpr int kBits = 6;
  static constexpr size_t kCells = size_t{1} << (3 * kBits);

  ColorTable() : labels_(kCells, 0) {}
  /// Throws: Error unless `labels` are kCells values in 0..kColorCount.
  explicit ColorTable(std::vector<uint8_t> labels, ColorSpace space = ColorSpace::yuv);

  /// `color`: in this space.
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

  /// Versioned and checksummed.
  /// Throws: Error.
  void save(const std::string& path) const;
  static ColorTable load(const std::string& path);

 private:
  std::vector<uint8_t> labels_;
  ColorSpace space_ = ColorSpace::yuv;
};

/// The label image L of the mapped image M.
LabelImage segment(const RegisteredImage& mapped, const ColorTable& table);
LabelImage segment(const ColorImage& color, const ColorTable& table);

/// The most frequent of 3x3 labels. Not in the paper.
LabelImage majority_filter(const LabelImage& labels);

/// Throws: Error.
ColorTable color_table_from_bytes(std::string_view bytes, const std::string& where);

inline constexpr double kSurfaceStep = 0.02;  ///< m
/// The most frequent label of those 3x3 pixels within `depth_step`, m. Ties go to the pixel's own label, else the
/// smallest. Unlabeled pixels need two votes. Not in the paper.
LabelImage surface_majority(const LabelImage& labels, const DepthImage& depth, double depth_step = kSurfaceStep);

}  // namespace glovebench
