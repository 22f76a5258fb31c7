#pragma once

#include <cmath>

#include "core/base/image.h"

namespace glovebench::render {

/// Central, where one of the neighbors has no value (0) one-sided, else 0.
inline float central_difference(float before, float here, float after) {
  if (before > 0 && after > 0) return (after - before) / 2;
  if (after > 0) return after - here;
  if (before > 0) return here - before;
  return 0;
}

/// Change of z by pixel.
struct Gradient {
  float du, dv;
};

/// `difference(before, here, after)` of neighbors in u and in v.
template <typename Difference>
Gradient gradient(const DepthImage& depth, int u, int v, Difference difference) {
  const float z = depth(u, v);
  const float left = u > 0 ? depth(u - 1, v) : 0;
  const float right = u + 1 < depth.width() ? depth(u + 1, v) : 0;
  const float above = v > 0 ? depth(u, v - 1) : 0;
  const float below = v + 1 < depth.height() ? depth(u, v + 1) : 0;
  return {difference(left, z, right), difference(above, z, below)};
}

/// |grad z| in metres per pixel: central differences (z(u+1) - z(u-1)) / 2 in u and v and their Euclidean norm.
/// Where one of the two neighbors has no value or lies outside the image, the one-sided difference to the other;
/// where both are missing, 0. Pixels without a value (z = 0) have gradient 0.
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
