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
  const float z = depth(u, v);
  const float left = u > 0 ? depth(u - 1, v) : 0;
  const float right = u + 1 < depth.width() ? depth(u + 1, v) : 0;
  const float above = v > 0 ? depth(u, v - 1) : 0;
  const float below = v + 1 < depth.height() ? depth(u, v + 1) : 0;
  return {difference(left, z, right), difference(above, z, below)};
}

/// m per pixel; 0 where z = 0.
inline Image<float> gradient_magnitude(const DepthImage& depth) {
  Image<float> magnitude(depth.width(), depth.height());
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (depth(u, v) <= 0) continue;
      const Gradient slope = gradient(depth, u, v, central_difference);
      magnitude(u, v) = std::sqrt(slope.du * slope.du + slope.dv * slope.dv);
    }
  }
  return magnitude;
}

}  // namespace glovebench::render
