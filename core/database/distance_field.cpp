#include "core/database/distance_field.h"

#include <algorithm>
#include <vector>

#include "core/base/check.h"

namespace glovebench {

void chamfer_field(const LabelImage& labels, uint8_t color, uint8_t cap, std::span<uint8_t> field) {
  check(field.size() == labels.size(), "a field has the size of its image");
  const int w = labels.width(), h = labels.height(), stride = w + 2;
  // One border pixel around the image saves the tests for it.
  std::vector<uint16_t> d(static_cast<size_t>(stride) * (h + 2), cap);
  bool present = false;
  for (int v = 0; v < h; ++v) {
    for (int u = 0; u < w; ++u) {
      if (labels(u, v) != color) continue;
      d[(v + 1) * stride + u + 1] = 0;
      present = true;
    }
  }
  if (!present) {
    std::fill(field.begin(), field.end(), cap);
    return;
  }
  const auto relax = [&](uint16_t& x, int straight, int diagonal_a, int diagonal_b, int side, const uint16_t* p) {
    int best = x;
    best = std::min(best, p[straight] + 3);
    best = std::min(best, p[side] + 3);
    best = std::min(best, p[diagonal_a] + 4);
    best = std::min(best, p[diagonal_b] + 4);
    x = static_cast<uint16_t>(best);
  };
  for (int v = 1; v <= h; ++v) {
    for (int u = 1; u <= w; ++u) {
      uint16_t* p = &d[v * stride + u];
      relax(*p, -stride, -stride - 1, -stride + 1, -1, p);
    }
  }
  for (int v = h; v >= 1; --v) {
    for (int u = w; u >= 1; --u) {
      uint16_t* p = &d[v * stride + u];
      relax(*p, stride, stride + 1, stride - 1, 1, p);
    }
  }
  for (int v = 0; v < h; ++v) {
    for (int u = 0; u < w; ++u) {
      field[static_cast<size_t>(v) * w + u] = static_cast<uint8_t>(d[(v + 1) * stride + u + 1]);
    }
  }
}

}  // namespace glovebench
