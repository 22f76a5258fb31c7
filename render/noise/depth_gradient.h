#pragma once

#include <cmath>

#include "core/base/image.h"

namespace glovebench::render {

/// One-sided beside a missing value (0).
inline float central_difference(float before, float here, float after) {
  if (before > 0 && after > 0) return (after - before) / 2;
  if (after > 0) return after - here;
  if (before > 0) return here - before;
  return 0;
}

/// of z, per pixel
struct Gradient {
  float du, dv;
};

/// `difference(before, here, after)` in u and v.
template <typename Difference>
Gradient gradient(const DepthImage& depth, int u, int v, Difference difference) {
  const float* z = &depth(u, v);
  const float left = u > 0 ? z[-1] : 0;
  const float right = u + 1 < depth.width() ? z[1] : 0;
  const float above = v > 0 ? z[-depth.width()] : 0;
  const float below = v + 1 < depth.height() ? z[depth.width()] : 0;
  return {difference(left, *z, right), difference(above, *z, below)};
}

/// m per pixel, by central differences.
inline float gradient_magnitude(const DepthImage& depth, int u, int v) {
  const Gradient slope = gradient(depth, u, v, central_difference);
  return std::sqrt(slope.du * slope.du + slope.dv * slope.dv);
}

}  // namespace glovebench::render
