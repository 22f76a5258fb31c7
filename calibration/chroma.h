#pragma once

#include <Eigen/Core>

#include "core/base/image.h"

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

}  // namespace glovebench::calibration
