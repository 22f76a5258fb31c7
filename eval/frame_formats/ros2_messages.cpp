#include "eval/frame_formats/ros2_messages.h"

#include <bit>
#include <vector>

#include "eval/frame_formats/color_view.h"

namespace glovebench::eval {
namespace {

static_assert(std::endian::native == std::endian::little, "the header says little-endian");

/// Values are aligned to their size, counted from the end of the four bytes of the header.
class Cdr {
 public:
  template <typename Number>
  Cdr& put(Number value) {
    while ((bytes_.size() - kHeaderBytes) % sizeof(value) != 0) bytes_ += '\0';
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
    return *this;
  }
  Cdr& count(size_t size) { return put(static_cast<uint32_t>(size)); }
  Cdr& text(std::string_view text) {
    count(text.size() + 1);
    bytes_.append(text).push_back('\0');
    return *this;
  }
  template <typename Numbers>
  Cdr& list(const Numbers& numbers) {
    for (const auto number : numbers) put(number);
    return *this;
  }
  Cdr& raw(const void* bytes, size_t size) {
    bytes_.append(static_cast<const char*>(bytes), size);
    return *this;
  }
  Cdr& header(const RosHeader& header) {
    put(static_cast<int32_t>(header.timestamp_us / 1'000'000));
    put(static_cast<uint32_t>(header.timestamp_us % 1'000'000) * 1000);
    return text(header.frame);
  }
  Cdr& point(const Eigen::Vector3d& p) { return list(p); }
  Cdr& transform(const Eigen::Isometry3d& T) {
    const Eigen::Quaterniond q(T.linear());
    return point(T.translation()).put(q.x()).put(q.y()).put(q.z()).put(q.w());
  }
  std::string take() { return std::move(bytes_); }

 private:
  static constexpr size_t kHeaderBytes = 4;
  std::string bytes_ = std::string("\0\1\0\0", kHeaderBytes);
};

template <typename Pixel>
std::string image_message(const RosHeader& header, const Image<Pixel>& image, std::string_view encoding) {
  const size_t step = image.width() * sizeof(Pixel);
  Cdr cdr;
  cdr.header(header).count(image.height()).count(image.width()).text(encoding).put(uint8_t{0}).count(step);
  cdr.count(step * image.height()).raw(image.data(), step * image.height());
  return cdr.take();
}

enum class MarkerKind : int32_t { line_list = 5, sphere_list = 7 };
struct MarkerStyle {
  int32_t number;
  MarkerKind kind;
  double width;  ///< m
};

void put_marker(Cdr& cdr, const RosHeader& header, std::string_view name, const MarkerStyle& style,
                std::span<const Eigen::Vector3d> points, const RosColor& color) {
  enum : int32_t { kAdd = 0, kDelete = 2 };
  cdr.header(header).text(name).put(style.number).put(style.kind).put(points.empty() ? kDelete : kAdd);
  cdr.transform(Eigen::Isometry3d::Identity()).list(std::array{style.width, style.width, style.width}).list(color);
  constexpr int32_t kSeconds = 0;
  constexpr uint32_t kNanoseconds = 0, kNone = 0;
  cdr.put(kSeconds).put(kNanoseconds).put(uint8_t{0});  // lasts until replaced; not frame-locked
  cdr.count(points.size());
  for (const Eigen::Vector3d& point : points) cdr.point(point);
  cdr.put(kNone);                               // colors
  cdr.text("");                                 // texture_resource
  cdr.header({0, ""}).text("").put(kNone);      // texture
  cdr.put(kNone).text("").text("").put(kNone);  // uv_coordinates, text, mesh_file
  cdr.text("").put(uint8_t{0});                 // mesh_resource, its materials
}

}  // namespace

std::string ros_image(const RosHeader& header, const ColorImage& image) {
  return image_message(header, image, "rgb8");
}

std::string ros_depth_image(const RosHeader& header, const DepthImage& depth) {
  return image_message(header, depth_in_steps(depth, 1000), "16UC1");
}

std::string ros_camera_info(const RosHeader& header, const PinholeCamera& camera) {
  constexpr int kDistortions = 5;
  Cdr cdr;
  cdr.header(header).count(camera.height).count(camera.width).text("plumb_bob");
  cdr.count(kDistortions).list(std::array<double, kDistortions>{});
  cdr.list(std::array{camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0});
  cdr.list(std::array{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0});
  cdr.list(std::array{camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0});
  cdr.list(std::array<uint32_t, 6>{}).put(uint8_t{0});  // binning, region of interest
  return cdr.take();
}

std::string ros_pose(const RosHeader& header, const Eigen::Isometry3d& T_frame_object) {
  return Cdr().header(header).transform(T_frame_object).take();
}

std::string ros_joint_state(const RosHeader& header, const Posture& posture) {
  Cdr cdr;
  cdr.header(header).count(kAngleCount);
  for (const AngleInfo& angle : angle_infos()) cdr.text(angle.name);
  cdr.count(kAngleCount).list(posture).count(0).count(0);  // no velocities, no efforts
  return cdr.take();
}

std::string ros_transform(const RosHeader& header, std::string_view child, const Eigen::Isometry3d& T_frame_child) {
  return Cdr().count(1).header(header).text(child).transform(T_frame_child).take();
}

std::string ros_markers(const RosHeader& header, std::string_view name, std::span<const Eigen::Vector3d> spheres,
                        std::span<const RosLine> lines, const RosColor& color) {
  std::vector<Eigen::Vector3d> ends;
  for (const RosLine& line : lines) ends.insert(ends.end(), {line.from, line.to});
  Cdr cdr;
  cdr.count(2);
  put_marker(cdr, header, name, {0, MarkerKind::sphere_list, 0.010}, spheres, color);
  put_marker(cdr, header, name, {1, MarkerKind::line_list, 0.004}, ends, color);
  return cdr.take();
}

}  // namespace glovebench::eval
