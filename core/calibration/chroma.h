#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/base/image.h"
#include "core/calibration/color_samples.h"

namespace glovebench::calibration {

/// Color without brightness: ((U - 128) / Y, (V - 128) / Y) of gamma-coded RGB (BT.601).
using Chroma = Eigen::Vector2d;

inline double luma_of(const Eigen::Array3d& rgb) { return 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2]; }
/// `rgb`: not black.
inline Chroma chroma_of(const Eigen::Array3d& rgb) {
  const double luma = luma_of(rgb);
  return {(rgb[2] - luma) / (1.772 * luma), (rgb[0] - luma) / (1.402 * luma)};
}
/// With Y = 1.
inline Eigen::Array3d rgb_of_chroma(const Chroma& chroma) {
  return {1 + 1.402 * chroma[1], 1 - 0.344136 * chroma[0] - 0.714136 * chroma[1], 1 + 1.772 * chroma[0]};
}
inline Eigen::Array3d array_of(const Rgb& rgb) {
  return {static_cast<double>(rgb[0]), static_cast<double>(rgb[1]), static_cast<double>(rgb[2])};
}

inline bool is_overexposed(const Rgb& rgb) {
  constexpr uint8_t kWhite = 251;
  return rgb[0] >= kWhite || rgb[1] >= kWhite || rgb[2] >= kWhite;
}

struct KnownChroma {
  Chroma place = Chroma::Zero();
  double reach = 0;  ///< no new peak within it
};

/// Density of samples in the chroma plane, smoothed by a Gaussian (peak 1, deviation `width`). Skips Y <
/// `min_luma`.
class ChromaDensity {
 public:
  ChromaDensity(std::span<const ColorSample> samples, double min_luma, double width);

  /// Weighted share of samples around `chroma`; 0 outside -1.2 to 2.
  double at(const Chroma& chroma) const;
  /// Up to `most` local maxima above `share`, highest first, outside reach and slope of known ones. New ones get
  /// `reach`.
  std::vector<Chroma> peaks(std::vector<KnownChroma> known, double reach, double share, size_t most) const;

 private:
  static constexpr int kSide = 320;
  static constexpr double kCell = 0.01, kLeast = -1.2;

  static Eigen::Vector2i cell_of(const Chroma& chroma);
  static bool is_inside(const Eigen::Vector2i& place);
  static size_t index(const Eigen::Vector2i& place);
  void blur(double width);
  bool is_flank(const Chroma& place, const KnownChroma& known) const;

  std::vector<double> cells_;
};

}  // namespace glovebench::calibration
