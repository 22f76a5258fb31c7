#include "core/database/distance_field.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "core/base/error.h"

namespace glovebench {
namespace {

constexpr int kStraight = 3;
constexpr int kDiagonal = 4;

/// min(x + step, 255) by byte operations of SSE2.
inline uint8_t plus(uint8_t x, uint8_t step) {
  return static_cast<uint8_t>(std::min<uint8_t>(x, static_cast<uint8_t>(255 - step)) + step);
}

/// Rows of bytes between margins that hold the cap: neighbors outside the image are never nearer.
class PaddedRows {
 public:
  static constexpr int kMaxStep = 64;  ///< pixels that a horizontal step reaches beyond a row

  PaddedRows(int width, int height, uint8_t cap)
      : width_(width),
        stride_(width + 2 * kMaxStep),
        bytes_(static_cast<size_t>(stride_) * static_cast<size_t>(height), cap) {}
  int width() const { return width_; }
  uint8_t* operator[](int v) { return bytes_.data() + static_cast<ptrdiff_t>(v) * stride_ + kMaxStep; }

 private:
  int width_;
  int stride_;
  std::vector<uint8_t> bytes_;
};

/// Takes smaller distances from the row above (or below).
void relax_vertically(uint8_t* __restrict row, const uint8_t* __restrict neighbor, int width) {
  for (int u = 0; u < width; ++u) {
    const uint8_t diagonal = plus(std::min(neighbor[u - 1], neighbor[u + 1]), kDiagonal);
    row[u] = std::min({row[u], plus(neighbor[u], kStraight), diagonal});
  }
}

/// Takes smaller distances from `step` pixels to the left or right.
void relax_horizontally(uint8_t* __restrict result, const uint8_t* __restrict row, int width, int step) {
  const auto cost = static_cast<uint8_t>(kStraight * step);
  for (int u = 0; u < width; ++u) result[u] = std::min(row[u], plus(std::min(row[u - step], row[u + step]), cost));
}

}  // namespace

void chamfer_field_plain(const LabelImage& labels, uint8_t color, uint8_t cap, std::span<uint8_t> field) {
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
  for (int v = 0; v < h; ++v)
    for (int u = 0; u < w; ++u)
      field[static_cast<size_t>(v) * w + u] = static_cast<uint8_t>(d[(v + 1) * stride + u + 1]);
}

void chamfer_field(const LabelImage& labels, uint8_t color, uint8_t cap, std::span<uint8_t> field) {
  chamfer_field(labels, color, cap, field, {0, labels.height()});
}

void chamfer_field(const LabelImage& labels, uint8_t color, uint8_t cap, std::span<uint8_t> field,
                   RowRange wanted) {
  const int w = labels.width(), h = labels.height();
  check(field.size() == labels.size(), "a field has the size of its image");
  check(wanted.first >= 0 && wanted.first <= wanted.last && wanted.last <= h, "rows of the image");
  if (std::memchr(labels.data(), color, labels.size()) == nullptr) {
    std::fill(field.begin(), field.end(), cap);
    return;
  }
  PaddedRows rows(w, h, cap);
  for (int v = 0; v < h; ++v) {
    const uint8_t* const label = labels.data() + static_cast<ptrdiff_t>(v) * w;
    for (int u = 0; u < w; ++u) rows[v][u] = label[u] == color ? 0 : cap;
  }
  for (int v = 1; v < wanted.last; ++v) relax_vertically(rows[v], rows[v - 1], w);
  for (int v = h - 2; v >= wanted.first; --v) relax_vertically(rows[v], rows[v + 1], w);

  // Steps of 1, 2, 4, ... pixels add up to every distance below the cap.
  PaddedRows spare(w, 1, cap);
  for (int v = wanted.first; v < wanted.last; ++v) {
    uint8_t* row = rows[v];
    uint8_t* other = spare[0];
    for (int step = 1; step <= PaddedRows::kMaxStep && step < w && kStraight * step < cap; step *= 2) {
      relax_horizontally(other, row, w, step);
      std::swap(row, other);
    }
    std::copy_n(row, w, field.data() + static_cast<ptrdiff_t>(v) * w);
  }
}

void chamfer_fields(const LabelImage& labels, uint8_t cap, std::span<uint8_t> fields) {
  for (size_t color = 1; color <= kColorCount; ++color)
    chamfer_field(labels, static_cast<uint8_t>(color), cap,
                  fields.subspan((color - 1) * labels.size(), labels.size()));
}

}  // namespace glovebench
