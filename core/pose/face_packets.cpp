#include "core/pose/face_packets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace glovebench {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Place of padding boxes, m: very far, with a finite square.
constexpr float kFar = 1e18f;

float longest_edge2(const Surface::Face& face) {
  return std::max(
      {(face.b - face.a).squaredNorm(), (face.c - face.a).squaredNorm(), (face.c - face.b).squaredNorm()});
}

FacePackets::Face make_face(const Surface::Face& face, int32_t index) {
  FacePackets::Face result;
  for (int axis = 0; axis < 3; ++axis) {
    result.a[axis] = face.a[axis];
    result.b[axis] = face.b[axis];
    result.c[axis] = face.c[axis];
    result.ab[axis] = face.b[axis] - face.a[axis];
    result.ac[axis] = face.c[axis] - face.a[axis];
  }
  result.face = index;
  return result;
}

template <int kCount>
Boxes<kCount> boxes_of_nothing() {
  Boxes<kCount> boxes;
  for (int i = 0; i < kCount; ++i) {
    for (int axis = 0; axis < 3; ++axis) boxes.low[axis][i] = boxes.high[axis][i] = kFar;
    boxes.length[i] = boxes.blur[i] = 0;
  }
  return boxes;
}

/// A face that is not finite, or has an infinite blur, gets an infinite box.
void set_box(Boxes<FacePackets::kFaces>& boxes, int i, const Surface::Face& face) {
  boxes.blur[i] = rounding_blur(face);
  const bool boundless = !(boxes.blur[i] < kInfinity);
  boxes.length[i] = boundless ? 1 : std::sqrt(longest_edge2(face));
  for (int axis = 0; axis < 3; ++axis) {
    boxes.low[axis][i] = boundless ? -kInfinity : std::min({face.a[axis], face.b[axis], face.c[axis]});
    boxes.high[axis][i] = boundless ? kInfinity : std::max({face.a[axis], face.b[axis], face.c[axis]});
  }
}

/// Around the first `count` boxes of a packet.
void set_box(Boxes<FacePackets::kPackets>& boxes, int i, const Boxes<FacePackets::kFaces>& packet, size_t count) {
  const auto most = [count](const float* values) { return *std::max_element(values, values + count); };
  for (int axis = 0; axis < 3; ++axis) {
    boxes.low[axis][i] = *std::min_element(packet.low[axis], packet.low[axis] + count);
    boxes.high[axis][i] = most(packet.high[axis]);
  }
  boxes.length[i] = most(packet.length);
  boxes.blur[i] = most(packet.blur);
}

}  // namespace

float rounding_blur(const Surface::Face& face) {
  const float length2 = longest_edge2(face);
  const float height2 = (face.b - face.a).cross(face.c - face.a).squaredNorm() / length2;
  // A smaller height is only rounding error.
  if (!(height2 > 1e-10f * length2) || length2 == kInfinity) return kInfinity;
  // Areas have a relative error of 8 * 2^-24 (D / height)^2: not the worst case, but several times the sum of
  // independent roundings. It moves the closest point by at most four times this share of the length; doubled.
  constexpr float kAreas = 8 * 0x1p-24f;
  return 2 * 4 * kAreas * std::sqrt(length2) / height2;
}

void FacePackets::assign(std::span<const Surface::Face> surface_faces) {
  faces.clear();
  face_boxes.clear();
  packet_boxes.clear();
  slack = 0;
  for (size_t first = 0; first < surface_faces.size(); first += kFaces) {
    const auto some = surface_faces.subspan(first, std::min<size_t>(kFaces, surface_faces.size() - first));
    Boxes<kFaces>& boxes = face_boxes.emplace_back(boxes_of_nothing<kFaces>());
    for (size_t i = 0; i < kFaces; ++i) {
      const size_t index = std::min(i, some.size() - 1);
      const Surface::Face& face = some[index];
      faces.push_back(make_face(face, static_cast<int32_t>(first + index)));
      if (i >= some.size()) continue;
      set_box(boxes, static_cast<int>(i), face);
      const Eigen::Vector3f middle = (face.a + face.b + face.c) / 3;
      if (middle.allFinite()) slack = std::max(slack, middle.lpNorm<Eigen::Infinity>());
    }
    const int packet = static_cast<int>(first / kFaces) % kPackets;
    if (packet == 0) packet_boxes.push_back(boxes_of_nothing<kPackets>());
    set_box(packet_boxes.back(), packet, boxes, some.size());
  }
  slack *= 1e-6f;  // a few roundings of the largest coordinate
}

}  // namespace glovebench
