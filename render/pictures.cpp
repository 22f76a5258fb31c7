#include "render/pictures.h"

#include <opencv2/imgproc.hpp>

#include "core/adapters/pictures/picture_files.h"
#include "core/base/error.h"
#include "core/base/whole_file.h"
#include "render/glove_colors.h"

namespace glovebench::render {
namespace {

constexpr int kTitleHeight = 20;
constexpr int kGap = 4;
const cv::Scalar kBackground(40, 40, 40);

cv::Mat as_mat(const ColorImage& image) {
  // Only read from: OpenCV has no view of constant pixels.
  return cv::Mat(image.height(), image.width(), CV_8UC3, const_cast<Rgb*>(image.data()));
}

/// In the colors of the sheet, which are RGB.
void put_text(cv::Mat& sheet, const std::string& text, int x, int y, const Rgb& color) {
  cv::putText(sheet, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, 0.42, {1.0 * color[0], 1.0 * color[1], 1.0 * color[2]},
              1, cv::LINE_AA);
}

ColorImage from_mat(const cv::Mat& mat) {
  ColorImage image(mat.cols, mat.rows);
  for (int v = 0; v < mat.rows; ++v) std::copy_n(mat.ptr<Rgb>(v), mat.cols, image.begin() + v * mat.cols);
  return image;
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
  Image<uint8_t> border(labels.width(), labels.height());
  for (int v = 0; v + 1 < labels.height(); ++v) {
    for (int u = 0; u + 1 < labels.width(); ++u) {
      const uint8_t label = labels(u, v);
      border(u, v) = label != labels(u + 1, v) || label != labels(u, v + 1);
    }
  }
  const auto is_beside_border = [&](int u, int v) {
    return (u > 0 && border(u - 1, v)) || (v > 0 && border(u, v - 1)) ||
           (u + 1 < border.width() && border(u + 1, v)) || (v + 1 < border.height() && border(u, v + 1));
  };
  ColorImage picture = color;
  for (int v = 0; v < border.height(); ++v) {
    for (int u = 0; u < border.width(); ++u)
      if (border(u, v))
        picture(u, v) = line;
      else if (is_beside_border(u, v))
        picture(u, v) = {0, 0, 0};
  }
  return picture;
}

ColorImage overlay_strokes(const ColorImage& color, std::span<const Stroke> strokes, const Rgb& line) {
  ColorImage picture = color;
  cv::Mat mat(picture.height(), picture.width(), CV_8UC3, picture.data());
  constexpr int kShift = 4;  // positions in 1/16 px
  const auto point = [](const Eigen::Vector2d& px) {
    return cv::Point(static_cast<int>(std::lround(px.x() * (1 << kShift))),
                     static_cast<int>(std::lround(px.y() * (1 << kShift))));
  };
  const auto draw = [&](const cv::Scalar& shade, int grown) {
    for (const Stroke& stroke : strokes) {
      cv::line(mat, point(stroke.from_px), point(stroke.to_px), shade, 1 + grown, cv::LINE_AA, kShift);
      for (const Eigen::Vector2d& end : {stroke.from_px, stroke.to_px})
        cv::circle(mat, point(end), (2 << kShift) + (grown << kShift) / 2, shade, cv::FILLED, cv::LINE_AA, kShift);
    }
  };
  draw({0, 0, 0}, 2);
  draw({static_cast<double>(line[0]), static_cast<double>(line[1]), static_cast<double>(line[2])}, 0);
  return picture;
}

ColorImage overlay_text(const ColorImage& color, const std::string& text) {
  ColorImage picture = color;
  cv::Mat mat(picture.height(), picture.width(), CV_8UC3, picture.data());
  for (const auto& [shade, thickness] : {std::pair{0, 3}, std::pair{255, 1}})
    cv::putText(mat, text, {8, 20}, cv::FONT_HERSHEY_SIMPLEX, 0.5, cv::Scalar::all(shade), thickness, cv::LINE_AA);
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

void write_png(const std::string& path, const ColorImage& image) { write_file(path, encode_png(image)); }

ColorImage montage(const std::vector<Panel>& panels, int columns, int cell_width, int cell_height) {
  const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
  const int step_x = cell_width + kGap, step_y = cell_height + kTitleHeight + kGap;
  cv::Mat sheet(rows * step_y + kGap, columns * step_x + kGap, CV_8UC3, kBackground);
  for (size_t i = 0; i < panels.size(); ++i) {
    const int x = kGap + static_cast<int>(i) % columns * step_x, y = kGap + static_cast<int>(i) / columns * step_y;
    put_text(sheet, panels[i].title, x + 2, y + 14, {230, 230, 230});
    const ColorImage& image = panels[i].image;
    if (image.empty()) continue;
    const double scale = std::min(static_cast<double>(cell_width) / image.width(),
                                  static_cast<double>(cell_height) / image.height());
    cv::Mat scaled;
    cv::resize(as_mat(image), scaled, {}, scale, scale, cv::INTER_NEAREST);
    scaled.copyTo(sheet(cv::Rect(x, y + kTitleHeight, scaled.cols, scaled.rows)));
  }
  return from_mat(sheet);
}

ColorImage picture_of_text(const std::vector<TextLine>& lines, int width, int height) {
  cv::Mat sheet(height, width, CV_8UC3, kBackground);
  for (size_t l = 0; l < lines.size(); ++l)
    put_text(sheet, lines[l].text, 2, kTitleHeight * static_cast<int>(l + 1) - 6, lines[l].color);
  return from_mat(sheet);
}

ColorImage crop_to_labels(const ColorImage& image, const LabelImage& labels, int margin) {
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
  if (right < 0) return image;
  const cv::Rect all(0, 0, image.width(), image.height());
  const cv::Rect box(left - margin, top - margin, right - left + 1 + 2 * margin, bottom - top + 1 + 2 * margin);
  return from_mat(as_mat(image)(box & all));
}

}  // namespace glovebench::render
