#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/base/image.h"
#include "core/calibration/color_samples.h"

namespace glovebench::calibration {

/// What is left of a color without its brightness: ((U - 128) / Y, (V - 128) / Y) over gamma-coded RGB (BT.601).
/// Shade moves a matte color's chroma little; camera noise of s gray levels moves it by about s / Y.
using Chroma = Eigen::Vector2d;

/// Y of gamma-coded R, G, B, in their unit.
inline double luma_of(const Eigen::Array3d& rgb) {
  return 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
}
/// `rgb` must not be black.
inline Chroma chroma_of(const Eigen::Array3d& rgb) {
  const double luma = luma_of(rgb);
  return {(rgb[2] - luma) / (1.772 * luma), (rgb[0] - luma) / (1.402 * luma)};
}
/// The color of that chroma with Y = 1.
inline Eigen::Array3d rgb_of_chroma(const Chroma& chroma) {
  return {1 + 1.402 * chroma[1], 1 - 0.344136 * chroma[0] - 0.714136 * chroma[1], 1 + 1.772 * chroma[0]};
}
inline Eigen::Array3d array_of(const Rgb& rgb) {
  return {static_cast<double>(rgb[0]), static_cast<double>(rgb[1]), static_cast<double>(rgb[2])};
}

/// A channel may have been cut off at white: the color is not known.
inline bool is_overexposed(const Rgb& rgb) {
  constexpr uint8_t kWhite = 251;
  return rgb[0] >= kWhite || rgb[1] >= kWhite || rgb[2] >= kWhite;
}

/// A place whose neighborhood is spoken for.
struct KnownChroma {
  Chroma place = Chroma::Zero();
  double reach = 0;  ///< as far as that
};

/// How many of the samples lie about each place of the chroma plane: shares, weighted by a bell of that width whose
/// height is 1. Samples darker than `min_luma` and chroma beyond -1.2 to 2 are left out.
class ChromaDensity {
 public:
  ChromaDensity(std::span<const ColorSample> samples, double min_luma, double width);

  /// 0 outside.
  double at(const Chroma& chroma) const;
  /// The places about which more than `share` lies, and more than about their neighbors, the highest first: out of
  /// reach of those that are known, and with a valley between unless they are the higher ones; those that are found
  /// are known to those after them, with that reach. At most that many.
  std::vector<Chroma> peaks(std::vector<KnownChroma> known, double reach, double share, size_t most) const;

 private:
  static constexpr int kSide = 320;
  static constexpr double kCell = 0.01, kLeast = -1.2;

  static Eigen::Vector2i cell_of(const Chroma& chroma);
  static bool is_inside(const Eigen::Vector2i& place);
  static size_t index(const Eigen::Vector2i& place);
  void blur(double width);
  /// Is the place on the way down from what is known?
  bool is_flank(const Chroma& place, const KnownChroma& known) const;

  std::vector<double> cells_;
};

}  // namespace glovebench::calibration
