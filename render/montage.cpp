#include "render/montage.h"

#include <opencv2/imgproc.hpp>

namespace glovebench::render {
namespace {

constexpr int kTitleHeight = 20;
constexpr int kGap = 4;
const cv::Scalar kBackground(40, 40, 40);

cv::Mat as_mat(const ColorImage& image) {
  // Only read from: OpenCV has no view of constant pixels.
  return cv::Mat(image.height(), image.width(), CV_8UC3, const_cast<Rgb*>(image.data()));
}

ColorImage from_mat(const cv::Mat& mat) {
  ColorImage image(mat.cols, mat.rows);
  for (int v = 0; v < mat.rows; ++v) std::copy_n(mat.ptr<Rgb>(v), mat.cols, image.begin() + v * mat.cols);
  return image;
}

}  // namespace

ColorImage montage(const std::vector<Panel>& panels, int columns, int cell_width, int cell_height) {
  const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
  const int step_x = cell_width + kGap, step_y = cell_height + kTitleHeight + kGap;
  cv::Mat sheet(rows * step_y + kGap, columns * step_x + kGap, CV_8UC3, kBackground);
  for (size_t i = 0; i < panels.size(); ++i) {
    const int x = kGap + static_cast<int>(i) % columns * step_x, y = kGap + static_cast<int>(i) / columns * step_y;
    cv::putText(sheet, panels[i].title, {x + 2, y + 14}, cv::FONT_HERSHEY_SIMPLEX, 0.42, {230, 230, 230}, 1,
                cv::LINE_AA);
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
