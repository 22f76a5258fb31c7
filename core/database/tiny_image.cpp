#include "core/database/tiny_image.h"

#include <algorithm>
#include <vector>

namespace glovebench {
namespace {

/// Pixels of each label; padded to the width of vector registers.
using Votes = std::array<uint16_t, 16>;
/// Cells up to this wide have no more pixels than a vote can count.
constexpr int kMaxCell = 250;  // px

/// The pixels under the cells of one axis, relative to the square.
struct CellRange {
  int first, last;  ///< half-open
};
CellRange cell_range(int cell, int side, int size) {
  return {cell * side / size, ((cell + 1) * side + size - 1) / size};
}

/// The label with the most votes, if 0 has no more.
template <typename Counts>
uint8_t winner(const Counts& votes) {
  const auto best = std::max_element(votes.begin() + 1, votes.begin() + kColorCount + 1);
  return *best > 0 && *best >= votes[0] ? static_cast<uint8_t>(best - votes.begin()) : uint8_t{0};
}

/// Counts the votes of each pixel column of the square over some of its rows; what lies outside the image is 0.
void count_columns(const LabelImage& labels, const Square& square, const CellRange& rows,
                   std::vector<Votes>& columns) {
  const int left = std::clamp(-square.left, 0, square.side);
  const int right = std::clamp(labels.width() - square.left, left, square.side);
  const int top = std::clamp(square.top + rows.first, 0, labels.height());
  const int bottom = std::clamp(square.top + rows.last, top, labels.height());
  const int height = rows.last - rows.first;
  for (int column = 0; column < square.side; ++column) {
    const bool inside = column >= left && column < right;
    columns[column] = {static_cast<uint16_t>(inside ? height - (bottom - top) : height)};
  }
  for (int v = top; v < bottom; ++v) {
    const uint8_t* const pixels = labels.data() + static_cast<ptrdiff_t>(v) * labels.width() + square.left;
    for (int column = left; column < right; ++column) ++columns[column][pixels[column]];
  }
}

}  // namespace

Square bounding_square(const LabelImage& labels) {
  const int width = labels.width();
  int left = width, right = -1, top = labels.height(), bottom = -1;
  for (int v = 0; v < labels.height(); ++v) {
    const uint8_t* const row = labels.data() + static_cast<ptrdiff_t>(v) * width;
    uint8_t any = 0;
    for (int u = 0; u < width; ++u) any |= row[u];
    if (any == 0) continue;
    top = std::min(top, v);
    bottom = v;
    // Only what lies outside the box so far can widen it.
    left = static_cast<int>(std::find_if(row, row + left, [](uint8_t label) { return label != 0; }) - row);
    int last = width - 1;
    while (last > right && row[last] == 0) --last;
    right = last;
  }
  if (right < 0) return {};
  const int side = std::max(right - left, bottom - top) + 1;
  return {left - (side - (right - left + 1)) / 2, top - (side - (bottom - top + 1)) / 2, side};
}

Eigen::Vector3d square_ray(const Square& square, const PinholeCamera& camera) {
  const double u = square.left + 0.5 * (square.side - 1), v = square.top + 0.5 * (square.side - 1);
  return camera.back_project(u, v, 1.0).normalized();
}

LabelImage make_tiny_image_plain(const LabelImage& labels, const Square& square, int size) {
  LabelImage tiny(size, size);
  if (square.side == 0) return tiny;
  for (int cv = 0; cv < size; ++cv) {
    const CellRange rows = cell_range(cv, square.side, size);
    for (int cu = 0; cu < size; ++cu) {
      const CellRange columns = cell_range(cu, square.side, size);
      std::array<int, kColorCount + 1> votes{};
      for (int v = square.top + rows.first; v < square.top + rows.last; ++v) {
        for (int u = square.left + columns.first; u < square.left + columns.last; ++u) {
          ++votes[labels.contains(u, v) ? labels(u, v) : 0];
        }
      }
      tiny(cu, cv) = winner(votes);
    }
  }
  return tiny;
}

LabelImage make_tiny_image(const LabelImage& labels, const Square& square, int size) {
  if (square.side > kMaxCell * size) return make_tiny_image_plain(labels, square, size);
  LabelImage tiny(size, size);
  if (square.side == 0) return tiny;
  std::vector<Votes> columns(square.side);
  for (int cv = 0; cv < size; ++cv) {
    count_columns(labels, square, cell_range(cv, square.side, size), columns);
    for (int cu = 0; cu < size; ++cu) {
      const CellRange range = cell_range(cu, square.side, size);
      Votes votes{};
      for (int column = range.first; column < range.last; ++column) {
        for (size_t label = 0; label < votes.size(); ++label) {
          votes[label] = static_cast<uint16_t>(votes[label] + columns[column][label]);
        }
      }
      tiny(cu, cv) = winner(votes);
    }
  }
  return tiny;
}

}  // namespace glovebench
