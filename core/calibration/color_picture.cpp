#include "core/calibration/color_report.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace glovebench::calibration {
namespace {

constexpr int kPlaneScale = 3;  // pixels a step of U and V
constexpr int kPlane = 192 * kPlaneScale;
constexpr int kPlaneFirst = 32;  // U and V from 32 to 223
constexpr int kViewWidth = 230, kViewHeight = kPlane, kMargin = 14, kTitle = 26;
constexpr int kPair = 2 * kViewWidth + 2 * kMargin;
const cv::Scalar kPaper(28, 28, 30), kInk(225, 225, 225);

/// Each color at screen brightness; gray for 0.
std::array<Rgb, kColorCount + 1> palette_of(const GloveColorFit& fit) {
  std::array<Rgb, kColorCount + 1> palette;
  palette[0] = {70, 70, 70};
  for (int k = 1; k <= kColorCount; ++k) {
    const Eigen::Array3d rgb = rgb_of_chroma(fit.colors[k].center).max(0);
    const Eigen::Array3d bright = 240 * rgb / rgb.maxCoeff();
    for (int i = 0; i < 3; ++i) palette[k][i] = static_cast<uint8_t>(bright[i]);
  }
  return palette;
}

/// The rectangle of labeled pixels with a margin; the whole image without any.
cv::Rect box_of(const VolumeView& view, const ColorTable& table) {
  int left = view.inside.width(), right = -1, top = view.inside.height(), bottom = -1;
  for (int v = 0; v < view.inside.height(); ++v)
    for (int u = 0; u < view.inside.width(); ++u)
      if (view.inside(u, v) != 0 && table.label(view.color(u, v)) != 0) {
        left = std::min(left, u);
        right = std::max(right, u);
        top = std::min(top, v);
        bottom = std::max(bottom, v);
      }
  const cv::Rect whole(0, 0, view.inside.width(), view.inside.height());
  constexpr int margin = 12;
  if (right < left) return whole;
  return cv::Rect(left - margin, top - margin, right - left + 1 + 2 * margin, bottom - top + 1 + 2 * margin) &
         whole;
}

void put(cv::Mat& picture, const cv::Mat& part, int left, int top) {
  const double scale =
      std::min(static_cast<double>(kViewWidth) / part.cols, static_cast<double>(kViewHeight) / part.rows);
  cv::Mat scaled;
  cv::resize(part, scaled, {}, scale, scale, cv::INTER_NEAREST);
  const int x = left + (kViewWidth - scaled.cols) / 2, y = top;
  scaled.copyTo(picture(cv::Rect(x, y, scaled.cols, scaled.rows)));
}

void write(cv::Mat& picture, const std::string& text, int left, int bottom, double size = 0.5) {
  cv::putText(picture, text, {left, bottom}, cv::FONT_HERSHEY_SIMPLEX, size, kInk, 1, cv::LINE_AA);
}

/// Draws the view beside the labels of its pixels in the volume.
void draw_view(cv::Mat& picture, const VolumeView& view, const ColorTable& table,
               const std::array<Rgb, kColorCount + 1>& palette, int left, int top) {
  const cv::Rect box = box_of(view, table);
  cv::Mat color(box.height, box.width, CV_8UC3), labels(box.height, box.width, CV_8UC3);
  for (int v = 0; v < box.height; ++v)
    for (int u = 0; u < box.width; ++u) {
      const Rgb& rgb = view.color(box.x + u, box.y + v);
      const bool inside = view.inside(box.x + u, box.y + v) != 0;
      const Rgb painted = inside ? palette[table.label(rgb)] : Rgb{0, 0, 0};
      color.at<cv::Vec3b>(v, u) = {rgb[0], rgb[1], rgb[2]};
      labels.at<cv::Vec3b>(v, u) = {painted[0], painted[1], painted[2]};
    }
  put(picture, color, left, top);
  put(picture, labels, left + kViewWidth + 4, top);
}

cv::Point point_of(const Chroma& chroma, double luma) {
  const Chroma uv = luma * chroma + Chroma(128 - kPlaneFirst, 128 - kPlaneFirst);
  // V upwards, as a vectorscope has it.
  return {static_cast<int>(std::lround(kPlaneScale * uv[0])),
          static_cast<int>(std::lround(kPlane - kPlaneScale * uv[1]))};
}

/// The table's regions at that luma, darkened.
cv::Mat plane_of(const ColorTable& table, const std::array<Rgb, kColorCount + 1>& palette, double luma) {
  cv::Mat plane(kPlane, kPlane, CV_8UC3);
  for (int y = 0; y < kPlane; ++y)
    for (int x = 0; x < kPlane; ++x) {
      const Chroma chroma = Chroma(kPlaneFirst - 128 + static_cast<double>(x) / kPlaneScale,
                                   kPlaneFirst - 128 + static_cast<double>(kPlane - y) / kPlaneScale) /
                            luma;
      const Eigen::Array3d rgb = (luma * rgb_of_chroma(chroma)).round();
      const bool is_color = rgb.minCoeff() >= 0 && rgb.maxCoeff() <= 255;
      const Rgb color =
          is_color ? Rgb{static_cast<uint8_t>(rgb[0]), static_cast<uint8_t>(rgb[1]), static_cast<uint8_t>(rgb[2])}
                   : Rgb{};
      const uint8_t label = is_color ? table.label(color) : uint8_t{0};
      const Rgb& shown = palette[label];
      const double shade = label == 0 ? (is_color ? 0.6 : 0.35) : 0.45;
      for (int i = 0; i < 3; ++i) plane.at<cv::Vec3b>(y, x)[i] = cv::saturate_cast<uint8_t>(shade * shown[i]);
    }
  return plane;
}

void draw_samples(cv::Mat& plane, const ColorSamples& samples, const GloveColorFit& fit,
                  const std::array<Rgb, kColorCount + 1>& palette, double luma) {
  constexpr size_t kDots = 20'000;
  const size_t stride = std::max<size_t>(1, samples.inside().size() / kDots);
  for (size_t i = 0; i < samples.inside().size(); i += stride) {
    const Eigen::Array3d rgb = array_of(samples.inside()[i].rgb);
    const double own = luma_of(rgb);
    if (own < 0.7 * luma || own > 1.4 * luma) continue;
    const uint8_t label = fit.classify(samples.inside()[i].rgb);
    const bool is_glove = label != kNotGlove && label != kUnsure;
    const cv::Point point = point_of(chroma_of(rgb), luma);
    if (cv::Rect(0, 0, kPlane, kPlane).contains(point)) {
      const Rgb dot = is_glove ? palette[label] : Rgb{160, 160, 160};
      plane.at<cv::Vec3b>(point) = {dot[0], dot[1], dot[2]};
    }
  }
}

void draw_bells(cv::Mat& plane, const GloveColorFit& fit, double luma) {
  for (int k = 1; k <= kColorCount; ++k) {
    const GloveColor& color = fit.colors[k];
    if (luma < 0.6 * color.lumas.front() || luma > 1.6 * color.lumas.back()) continue;
    const double noise = fit.noise_gray / luma;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(color.covariance +
                                                              noise * noise * Eigen::Matrix2d::Identity());
    std::vector<cv::Point> ring;
    for (int step = 0; step < 48; ++step) {
      const double angle = 2 * std::numbers::pi * step / 48;
      const Eigen::Vector2d unit(std::cos(angle), std::sin(angle));
      ring.push_back(point_of(
          color.center + 2 * axes.eigenvectors() * axes.eigenvalues().cwiseSqrt().cwiseProduct(unit), luma));
    }
    cv::polylines(plane, ring, true, kInk, 1, cv::LINE_AA);
    const cv::Point center = point_of(color.center, luma);
    const cv::Point label(center.x + 10, center.y - 10);
    cv::putText(plane, std::to_string(k), label, cv::FONT_HERSHEY_SIMPLEX, 0.55, cv::Scalar(0, 0, 0), 4,
                cv::LINE_AA);
    cv::putText(plane, std::to_string(k), label, cv::FONT_HERSHEY_SIMPLEX, 0.55, kInk, 1, cv::LINE_AA);
  }
}

void draw_plane(cv::Mat& picture, const ColorSamples& samples, const GloveColorFit& fit, const ColorTable& table,
                double luma, int left, int top) {
  const auto palette = palette_of(fit);
  cv::Mat plane = plane_of(table, palette, luma);
  draw_samples(plane, samples, fit, palette, luma);
  draw_bells(plane, fit, luma);
  const cv::Point gray = point_of(Chroma::Zero(), luma);
  cv::drawMarker(plane, gray, kInk, cv::MARKER_CROSS, 14, 1, cv::LINE_AA);
  write(plane, "U", kPlane - 20, gray.y - 6);
  write(plane, "V", gray.x + 6, 16);
  plane.copyTo(picture(cv::Rect(left, top, kPlane, kPlane)));
  write(picture, fmt::format("color table, samples and fitted Gaussians at Y = {:.0f}", luma), left, top - 8);
}

}  // namespace

ColorImage color_picture(std::span<const VolumeView> views, const ColorSamples& samples, const GloveColorFit& fit,
                         const ColorTable& table) {
  const int height = 2 * (kTitle + kPlane + kMargin), plane_left = kMargin + 2 * kPair;
  cv::Mat picture(height, plane_left + kPlane + kMargin, CV_8UC3, kPaper);
  write(picture, "recording, and its labels (gray: in the volume without one)", kMargin, kTitle - 8);
  const auto palette = palette_of(fit);
  for (int i = 0; i < std::min<int>(4, static_cast<int>(views.size())); ++i)
    draw_view(picture, views[i], table, palette, kMargin + i % 2 * kPair,
              kTitle + i / 2 * (kPlane + kMargin + kTitle));
  draw_plane(picture, samples, fit, table, 60, plane_left, kTitle);
  draw_plane(picture, samples, fit, table, 130, plane_left, 2 * kTitle + kPlane + kMargin);
  ColorImage image(picture.cols, picture.rows);
  for (int v = 0; v < picture.rows; ++v)
    for (int u = 0; u < picture.cols; ++u) {
      const cv::Vec3b& pixel = picture.at<cv::Vec3b>(v, u);
      image(u, v) = {pixel[0], pixel[1], pixel[2]};
    }
  return image;
}

}  // namespace glovebench::calibration
