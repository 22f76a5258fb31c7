#include "eval/sources/ros_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/text.h"
#include "eval/sources/field_reader.h"

namespace glovebench::eval {
namespace {

constexpr size_t kLongestRosName = 256;

/// ROS 2 aligns values to their size, counted from behind the four bytes of the header, and ends texts by 0.
class RosReader {
 public:
  RosReader(const RosMessage& message, const std::string& where, std::string field)
      : is_aligned_(message.encoding == RosEncoding::cdr),
        where_(where),
        field_(std::move(field)),
        fields_(message.bytes.substr(is_aligned_ ? std::min(kHeader.size(), message.bytes.size()) : 0), where_,
                field_) {
    if (is_aligned_ && !message.bytes.starts_with(kHeader)) fields_.fail("another encoding", "CDR, little-endian");
  }
  RosReader(const RosReader&) = delete;
  RosReader& operator=(const RosReader&) = delete;

  template <typename Number>
  Number number() {
    if (is_aligned_) fields_.align(sizeof(Number));
    return fields_.number<Number>();
  }
  /// A number of items of at least `bytes` each.
  size_t count(size_t bytes) {
    const auto items = number<uint32_t>();
    if (items > fields_.left() / bytes)
      fail(fmt::format("{} items", items), fmt::format("fewer, of {} bytes", bytes));
    return items;
  }
  std::string_view bytes() { return fields_.take(number<uint32_t>()); }
  std::string name() {
    std::string_view text = bytes();
    if (is_aligned_ && text.ends_with('\0')) text.remove_suffix(1);
    if (text.size() > kLongestRosName) fail(quoted_excerpt(text), fmt::format("at most {} bytes", kLongestRosName));
    return std::string(text);
  }
  template <size_t kCount>
  std::array<double, kCount> numbers() {
    std::array<double, kCount> values;
    for (double& value : values) value = number<double>();
    return values;
  }
  RosHead head() {
    if (!is_aligned_) number<uint32_t>();  // sequence
    const auto seconds = number<int32_t>();
    const auto nanoseconds = number<uint32_t>();
    if (seconds < 0) fail(fmt::format("a time of {} s", seconds), "a time from 1970 on");
    return {int64_t{seconds} * 1'000'000 + nanoseconds / 1000, name()};
  }
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    fields_.fail(found, expected);
  }

 private:
  static constexpr std::string_view kHeader = std::string_view("\0\1\0\0", 4);

  const bool is_aligned_;
  const std::string& where_;
  const std::string field_;
  FieldReader fields_;
};

struct ImageSize {
  int width, height;
};
ImageSize size_from(RosReader& reader) {
  const auto height = reader.number<uint32_t>(), width = reader.number<uint32_t>();
  if (width < 1 || height < 1 || width > kMostSide_px || height > kMostSide_px || width * height > kMostPixels)
    reader.fail(fmt::format("{}x{} pixels", width, height), fmt::format("at most {} pixels", kMostPixels));
  return {static_cast<int>(width), static_cast<int>(height)};
}

/// Calls `put(i, pixel)` for each pixel.
template <typename Pixel, typename Put>
void for_each_pixel(const RosImage& image, const std::string& where, const Put& put) {
  const size_t row = image.width * sizeof(Pixel);
  if (image.step < row || image.bytes.size() / image.step < static_cast<size_t>(image.height))
    throw Error(where, "image", fmt::format("{} bytes, {} a row", image.bytes.size(), image.step),
                fmt::format("{}x{} pixels of {} bytes", image.width, image.height, sizeof(Pixel)));
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      Pixel pixel;
      std::memcpy(&pixel, image.bytes.data() + v * image.step + u * sizeof(Pixel), sizeof(Pixel));
      put(static_cast<size_t>(v) * image.width + u, pixel);
    }
  }
}

LensDistortion lens_from(RosReader& reader) {
  const std::string model = reader.name();
  constexpr size_t kMost = 5;
  std::array<double, kMost> d{};
  const size_t count = reader.count(sizeof(double));
  for (size_t i = 0; i < count; ++i) {
    const auto value = reader.number<double>();
    if (i < kMost) d[i] = value;
    const bool is_known = i < kMost && (model.empty() || model == "plumb_bob");
    if (value != 0 && !is_known)
      reader.fail(fmt::format("distortion {} of {} numbers", quoted_excerpt(model), count),
                  "plumb_bob of at most 5, or zeros");
  }
  return {.k1 = d[0], .k2 = d[1], .p1 = d[2], .p2 = d[3], .k3 = d[4]};
}

}  // namespace

RosImage parse_ros_image(const RosMessage& message, const std::string& where) {
  RosReader reader(message, where, "image");
  RosImage image;
  image.head = reader.head();
  const ImageSize size = size_from(reader);
  image.width = size.width;
  image.height = size.height;
  image.encoding = reader.name();
  if (reader.number<uint8_t>() != 0) reader.fail("big-endian pixels", "little-endian ones");
  image.step = reader.number<uint32_t>();
  image.bytes = reader.bytes();
  return image;
}

ColorImage color_of(const RosImage& image, const std::string& where) {
  const bool is_bgr = image.encoding == "bgr8";
  if (!is_bgr && image.encoding != "rgb8")
    throw Error(where, "color image", quoted_excerpt(image.encoding), "rgb8 or bgr8");
  ColorImage color(image.width, image.height);
  for_each_pixel<Rgb>(image, where, [&](size_t i, Rgb pixel) {
    if (is_bgr) std::swap(pixel[0], pixel[2]);
    color[i] = pixel;
  });
  return color;
}

DepthImage depth_of(const RosImage& image, const std::string& where) {
  DepthImage depth(image.width, image.height);
  if (image.encoding == "16UC1" || image.encoding == "mono16") {
    for_each_pixel<uint16_t>(image, where,
                             [&](size_t i, uint16_t mm) { depth[i] = static_cast<float>(mm / 1000.0); });
  } else if (image.encoding == "32FC1") {
    for_each_pixel<float>(image, where, [&](size_t i, float z) { depth[i] = z > 0 && std::isfinite(z) ? z : 0; });
  } else {
    throw Error(where, "depth image", quoted_excerpt(image.encoding), "16UC1, mono16 or 32FC1");
  }
  return depth;
}

RosCamera parse_ros_camera(const RosMessage& message, const std::string& where) {
  RosReader reader(message, where, "CameraInfo");
  reader.head();
  RosCamera info;
  const auto [width, height] = size_from(reader);
  info.lens = lens_from(reader);
  const auto K = reader.numbers<9>();
  reader.numbers<9>();  // R turns stereo cameras
  const auto P = reader.numbers<12>();
  info.camera = {.width = width, .height = height, .fx = K[0], .fy = K[4], .cx = K[2], .cy = K[5]};
  info.rectified = {.width = width, .height = height, .fx = P[0], .fy = P[5], .cx = P[2], .cy = P[6]};
  return info;
}

std::vector<RosTransform> parse_ros_transforms(const RosMessage& message, const std::string& where) {
  constexpr size_t kLeastBytes = 72;  // of a transform
  constexpr double kMost_m = 1000, kNormTolerance = 1e-3;
  RosReader reader(message, where, "transforms");
  std::vector<RosTransform> transforms(reader.count(kLeastBytes));
  for (RosTransform& transform : transforms) {
    transform.parent = reader.head().frame;
    transform.child = reader.name();
    const auto p = reader.numbers<3>();
    const auto q = reader.numbers<4>();
    const Eigen::Vector3d translation(p[0], p[1], p[2]);
    const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
    if (!(std::abs(rotation.norm() - 1) <= kNormTolerance) || !(translation.norm() <= kMost_m))
      reader.fail(fmt::format("{} in {}", quoted_excerpt(transform.child), quoted_excerpt(transform.parent)),
                  "a rotation by a unit quaternion, and at most 1 km");
    transform.T_parent_child = Eigen::Translation3d(translation) * rotation.normalized();
  }
  return transforms;
}

}  // namespace glovebench::eval
