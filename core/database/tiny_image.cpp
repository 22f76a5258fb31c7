#include "core/database/tiny_image.h"

#include <algorithm>

namespace glovebench {

Square bounding_square(const LabelImage& labels) {
  int left = labels.width(), right = -1, top = labels.height(), bottom = -1;
  for (int v = 0; v < labels.height(); ++v) {
    for (int u = 0; u < labels.width(); ++u) {
      if (labels(u, v) == 0) continue;
      left = std::min(left, u);
      right = std::max(right, u);
      top = std::min(top, v);
      bottom = std::max(bottom, v);
    }
  }
  if (right < 0) return {};
  const int side = std::max(right - left, bottom - top) + 1;
  return {left - (side - (right - left + 1)) / 2, top - (side - (bottom - top + 1)) / 2, side};
}

Eigen::Vector3d square_ray(const Square& square, const PinholeCamera& camera) {
  const double u = square.left + 0.5 * (square.side - 1), v = square.top + 0.5 * (square.side - 1);
  return camera.back_project(u, v, 1.0).normalized();
}

LabelImage make_tiny_image(const LabelImage& labels, const Square& square, int size) {
  LabelImage tiny(size, size);
  if (square.side == 0) return tiny;
  // A cell covers the pixels from floor to ceil of its edges: at least one, also where the square is smaller.
  const auto first = [&](int cell) { return cell * square.side / size; };
  const auto last = [&](int cell) { return ((cell + 1) * square.side + size - 1) / size; };
  for (int cv = 0; cv < size; ++cv) {
    for (int cu = 0; cu < size; ++cu) {
      std::array<int, kColorCount + 1> votes{};
      for (int v = square.top + first(cv); v < square.top + last(cv); ++v) {
        for (int u = square.left + first(cu); u < square.left + last(cu); ++u) {
          ++votes[labels.contains(u, v) ? labels(u, v) : 0];
        }
      }
      const int color = static_cast<int>(std::max_element(votes.begin() + 1, votes.end()) - votes.begin());
      if (votes[color] > 0 && votes[color] >= votes[0]) tiny(cu, cv) = static_cast<uint8_t>(color);
    }
  }
  return tiny;
}

}  // namespace glovebench
