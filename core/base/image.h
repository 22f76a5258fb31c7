#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/base/recycled_vector.h"

namespace glovebench {

/// Row-major pixels; row 0 is the top.
template <typename T>
class Image {
 public:
  Image() = default;
  Image(int width, int height, T fill = T{})
      : width_(width), height_(height), pixels_(static_cast<size_t>(width) * height, fill) {}

  int width() const { return width_; }
  int height() const { return height_; }
  size_t size() const { return pixels_.size(); }
  bool empty() const { return pixels_.empty(); }
  bool contains(int u, int v) const { return u >= 0 && v >= 0 && u < width_ && v < height_; }

  T& operator()(int u, int v) { return pixels_[static_cast<size_t>(v) * width_ + u]; }
  const T& operator()(int u, int v) const { return pixels_[static_cast<size_t>(v) * width_ + u]; }
  T& operator[](size_t i) { return pixels_[i]; }
  const T& operator[](size_t i) const { return pixels_[i]; }
  /// Hardened builds check only the row.
  T* row(int v) { return &pixels_[static_cast<size_t>(v) * width_]; }
  const T* row(int v) const { return &pixels_[static_cast<size_t>(v) * width_]; }
  T* data() { return pixels_.data(); }
  const T* data() const { return pixels_.data(); }
  auto begin() { return pixels_.begin(); }
  auto end() { return pixels_.end(); }
  auto begin() const { return pixels_.begin(); }
  auto end() const { return pixels_.end(); }

  friend bool operator==(const Image&, const Image&) = default;

 private:
  int width_ = 0;
  int height_ = 0;
  RecycledVector<T> pixels_;
};

/// 0..255 per channel.
using Rgb = std::array<uint8_t, 3>;
using ColorImage = Image<Rgb>;
/// z along the optical axis, m; not the ray's length. 0: no value.
using DepthImage = Image<float>;
/// 1..kColorCount; 0 off the glove.
using LabelImage = Image<uint8_t>;

/// Paper: section III-A.
inline constexpr int kColorCount = 10;

template <typename Visit>
void for_each_nonzero(const Image<uint8_t>& image, int v, const Visit& visit) {
  const uint8_t* const row = image.data() + static_cast<size_t>(v) * image.width();
  for (int u = 0; u < image.width();) {
    const int end = std::min(u + 8, image.width());
    uint64_t eight = 1;
    if (end == u + 8) std::memcpy(&eight, row + u, 8);
    if (eight == 0) {
      u = end;
      continue;
    }
    for (; u < end; ++u)
      if (row[u] != 0) visit(u);
  }
}

}  // namespace glovebench
