#include "core/kinect/rectified_device.h"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

#include "core/base/error.h"
#include "core/kinect/disparity.h"

namespace glovebench {
namespace {

/// OpenCV's view of an image, whose pixels it does not own.
template <typename T>
cv::Mat as_mat(const Image<T>& image, int type) {
  return cv::Mat(image.height(), image.width(), type, const_cast<T*>(image.data()));
}

/// `places`: pixels of the distorted image, where it has them.
template <typename T, typename Places>
Image<T> nearest_pixels(const Image<T>& distorted, const Places& places, int type, T outside) {
  check(distorted.width() == places.width() && distorted.height() == places.height(),
        "the depth image has the size of the calibrated camera");
  Image<T> rectified(places.width(), places.height());
  cv::Mat result = as_mat(rectified, type);
  cv::remap(as_mat(distorted, type), result, as_mat(places, CV_16SC2), cv::noArray(), cv::INTER_NEAREST,
            cv::BORDER_CONSTANT, cv::Scalar(outside));
  return rectified;
}

}  // namespace

void require_unfolded(const PinholeCamera& camera, const LensDistortion& lens) {
  constexpr int kStep_px = 8;
  const auto distorted = [&](int u, int v) {
    return lens.distort({(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy});
  };
  for (int v = 0; v <= camera.height; v += kStep_px) {
    for (int u = 0; u <= camera.width; u += kStep_px) {
      const Eigen::Vector2d at = distorted(u, v);
      const Eigen::Vector2d right = distorted(u + 1, v) - at, down = distorted(u, v + 1) - at;
      if (!(right.x() * down.y() - right.y() * down.x() > 0))
        throw Error("calibration", "distortion", fmt::format("an image that folds over at pixel ({}, {})", u, v),
                    "coefficients that can be undone within the image");
    }
  }
}

Rectification::Rectification(const PinholeCamera& camera, const LensDistortion& lens)
    : nearest_(camera.width, camera.height),
      top_left_(camera.width, camera.height),
      fractions_(camera.width, camera.height) {
  require_unfolded(camera, lens);
  cv::Mat at(camera.height, camera.width, CV_32FC2);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector2d xy = lens.distort({(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy});
      // The map has 16 bits, in which a pixel far outside the image would wrap around.
      const Eigen::Vector2d uv_px(std::clamp(camera.fx * xy.x() + camera.cx, -2.0, camera.width + 1.0),
                                  std::clamp(camera.fy * xy.y() + camera.cy, -2.0, camera.height + 1.0));
      at.at<cv::Vec2f>(v, u) = {static_cast<float>(uv_px.x()), static_cast<float>(uv_px.y())};
    }
  }
  cv::Mat nearest = as_mat(nearest_, CV_16SC2), top_left = as_mat(top_left_, CV_16SC2),
          fractions = as_mat(fractions_, CV_16UC1), unused;
  cv::convertMaps(at, cv::noArray(), nearest, unused, CV_16SC2, true);
  cv::convertMaps(at, cv::noArray(), top_left, fractions, CV_16SC2, false);
}

Image<uint16_t> Rectification::operator()(const Image<uint16_t>& raw_disparity) const {
  return nearest_pixels(raw_disparity, nearest_, CV_16UC1, kNoDisparity);
}

DepthImage Rectification::operator()(const DepthImage& depth) const {
  return nearest_pixels(depth, nearest_, CV_32FC1, 0.0f);
}

ColorImage Rectification::operator()(const ColorImage& color) const {
  check(color.width() == top_left_.width() && color.height() == top_left_.height(),
        "the color image has the size of the calibrated camera");
  ColorImage rectified(top_left_.width(), top_left_.height());
  cv::Mat result = as_mat(rectified, CV_8UC3);
  cv::remap(as_mat(color, CV_8UC3), result, as_mat(top_left_, CV_16SC2), as_mat(fractions_, CV_16UC1),
            cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar());
  return rectified;
}

RectifiedDevice::RectifiedDevice(std::unique_ptr<Device> device)
    : device_(std::move(device)), calibration_(device_->calibration().rectified()) {
  require_unfolded(calibration_.ir, device_->calibration().ir_lens);
  require_unfolded(calibration_.rgb, device_->calibration().rgb_lens);
}

std::optional<DeviceFrame> RectifiedDevice::next_frame() {
  std::optional<DeviceFrame> frame = device_->next_frame();
  if (!frame) return frame;
  // Made with the first frame, not before: a calibration may claim large images without having any.
  if (!ir_) ir_.emplace(calibration_.ir, device_->calibration().ir_lens);
  if (!rgb_) rgb_.emplace(calibration_.rgb, device_->calibration().rgb_lens);
  if (!frame->raw_disparity.empty()) frame->raw_disparity = (*ir_)(frame->raw_disparity);
  if (!frame->depth.empty()) frame->depth = (*ir_)(frame->depth);
  frame->color = (*rgb_)(frame->color);
  return frame;
}

std::unique_ptr<Device> without_lens_distortion(std::unique_ptr<Device> device) {
  if (!device->calibration().has_lens()) return device;
  return std::make_unique<RectifiedDevice>(std::move(device));
}

}  // namespace glovebench
