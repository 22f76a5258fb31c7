#include "render/pictures.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/base/whole_file.h"
#include "render/glove_colors.h"

namespace glovebench::render {
namespace {

/// The bytes of an image file.
std::string encode(const ColorImage& image, const char* extension, const std::vector<int>& parameters) {
  cv::Mat bgr(image.height(), image.width(), CV_8UC3);
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const Rgb& rgb = image(u, v);
      bgr.at<cv::Vec3b>(v, u) = {rgb[2], rgb[1], rgb[0]};
    }
  }
  std::vector<uint8_t> bytes;
  check(cv::imencode(extension, bgr, bytes, parameters), "an image encodes");
  return {bytes.begin(), bytes.end()};
}

}  // namespace

ColorImage picture_of_labels(const LabelImage& labels) {
  ColorImage picture(labels.width(), labels.height());
  for (size_t i = 0; i < labels.size(); ++i) {
    check(labels[i] <= kColorCount, "a label image holds labels 0..kColorCount");
    picture[i] = label_palette()[labels[i]];
  }
  return picture;
}

ColorImage picture_of_depth(const DepthImage& depth, double z_near, double z_far) {
  cv::Mat ramp(1, 256, CV_8UC1);
  for (int i = 0; i < 256; ++i) ramp.at<uint8_t>(i) = static_cast<uint8_t>(255 - i);
  cv::Mat colors;
  cv::applyColorMap(ramp, colors, cv::COLORMAP_TURBO);
  ColorImage picture(depth.width(), depth.height());
  for (size_t i = 0; i < depth.size(); ++i) {
    if (depth[i] <= 0) continue;
    const double share = std::clamp((depth[i] - z_near) / (z_far - z_near), 0.0, 1.0);
    const auto& bgr = colors.at<cv::Vec3b>(static_cast<int>(std::lround(255 * share)));
    picture[i] = {bgr[2], bgr[1], bgr[0]};
  }
  return picture;
}

ColorImage overlay_outline(const ColorImage& color, const LabelImage& labels, const Rgb& line) {
  check(color.width() == labels.width() && color.height() == labels.height(), "outline and image have one size");
  ColorImage picture = color;
  for (int v = 0; v + 1 < labels.height(); ++v) {
    for (int u = 0; u + 1 < labels.width(); ++u) {
      const uint8_t label = labels(u, v);
      if (label != labels(u + 1, v) || label != labels(u, v + 1)) picture(u, v) = line;
    }
  }
  return picture;
}

ColorImage picture_of_depth_difference(const DepthImage& depth, const DepthImage& other, double range) {
  check(depth.width() == other.width() && depth.height() == other.height(), "depth images have one size");
  constexpr std::array<double, 3> kLess = {33, 102, 172}, kNone = {247, 247, 247}, kMore = {178, 88, 10};
  constexpr Rgb kOnlyOne = {128, 128, 128}, kNeither = {20, 25, 31};
  ColorImage picture(depth.width(), depth.height(), kNeither);
  for (size_t i = 0; i < depth.size(); ++i) {
    const bool has_depth = depth[i] > 0, has_other = other[i] > 0;
    if (has_depth != has_other) picture[i] = kOnlyOne;
    if (!has_depth || !has_other) continue;
    const double share = std::clamp((other[i] - depth[i]) / range, -1.0, 1.0);
    const std::array<double, 3>& end = share < 0 ? kLess : kMore;
    for (size_t c = 0; c < 3; ++c)
      picture[i][c] = static_cast<uint8_t>(std::lround(kNone[c] + std::abs(share) * (end[c] - kNone[c])));
  }
  return picture;
}

std::string encode_png(const ColorImage& image) {
  return encode(image, ".png", {});
}

std::string encode_jpeg(const ColorImage& image, int quality) {
  return encode(image, ".jpg", {cv::IMWRITE_JPEG_QUALITY, quality});
}

void write_png(const std::string& path, const ColorImage& image) {
  write_file(path, encode_png(image));
}

}  // namespace glovebench::render
