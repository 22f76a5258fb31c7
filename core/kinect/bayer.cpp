#include "core/kinect/bayer.h"

#include <string>

#include "core/base/error.h"

namespace glovebench {
namespace {

/// 0 red, 1 green, 2 blue.
int channel_at(int u, int v) {
  if (u % 2 == v % 2) return 1;
  return v % 2 == 0 ? 0 : 2;
}

void require_squares(int width, int height) {
  if (width < 2 || height < 2 || width % 2 != 0 || height % 2 != 0)
    throw Error("Bayer image", "size", std::to_string(width) + "x" + std::to_string(height),
                "even sides of at least 2 px");
}

/// The mean of one color over the pixel and its neighbors, rounded.
uint8_t mean_of(const Image<uint8_t>& mosaic, int u, int v, int channel) {
  int sum = 0, count = 0;
  for (int y = v - 1; y <= v + 1; ++y) {
    for (int x = u - 1; x <= u + 1; ++x) {
      if (!mosaic.contains(x, y) || channel_at(x, y) != channel) continue;
      sum += mosaic(x, y);
      ++count;
    }
  }
  return static_cast<uint8_t>((sum + count / 2) / count);
}

}  // namespace

ColorImage color_from_bayer(const Image<uint8_t>& mosaic) {
  require_squares(mosaic.width(), mosaic.height());
  ColorImage color(mosaic.width(), mosaic.height());
  for (int v = 0; v < mosaic.height(); ++v) {
    for (int u = 0; u < mosaic.width(); ++u) {
      const int own = channel_at(u, v);
      for (int channel = 0; channel < 3; ++channel)
        color(u, v)[channel] = channel == own ? mosaic(u, v) : mean_of(mosaic, u, v, channel);
    }
  }
  return color;
}

Image<uint8_t> bayer_from_color(const ColorImage& color) {
  require_squares(color.width(), color.height());
  Image<uint8_t> mosaic(color.width(), color.height());
  for (int v = 0; v < color.height(); ++v)
    for (int u = 0; u < color.width(); ++u) mosaic(u, v) = color(u, v)[channel_at(u, v)];
  return mosaic;
}

}  // namespace glovebench
