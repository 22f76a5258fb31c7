#include "core/pose/face_packets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace glovebench {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Where the boxes of no packet are, m: farther than anything whose distance can be squared.
constexpr float kFar = 1e18f;

/// Orders faces so that each run of kFaces is compact: halves them across the longest extent of their middles, at a
/// multiple of kFaces, and each half again.
void sort_into_packets(std::span<int32_t> order, std::span<const Eigen::Vector3f> middles) {
  constexpr size_t kFaces = FacePackets::kFaces;
  if (order.size() <= kFaces) return;
  Eigen::AlignedBox3f box;
  for (const int32_t face : order) box.extend(middles[face]);
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const size_t packets = (order.size() + kFaces - 1) / kFaces;
  const size_t left = packets / 2 * kFaces;
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(left), order.end(),
                   [&](int32_t x, int32_t y) { return middles[x][axis] < middles[y][axis]; });
  sort_into_packets(order.first(left), middles);
  sort_into_packets(order.subspan(left), middles);
}

float longest_edge2(const Surface::Face& face) {
  return std::max(
      {(face.b - face.a).squaredNorm(), (face.c - face.a).squaredNorm(), (face.c - face.b).squaredNorm()});
}

FacePackets::Packet make_packet(std::span<const int32_t> order, std::span<const Surface::Face> faces) {
  FacePackets::Packet packet;
  for (int i = 0; i < FacePackets::kFaces; ++i) {
    packet.face[i] = order[std::min<size_t>(i, order.size() - 1)];
    const Surface::Face& face = faces[packet.face[i]];
    for (int axis = 0; axis < 3; ++axis) {
      packet.a[axis][i] = face.a[axis];
      packet.b[axis][i] = face.b[axis];
      packet.c[axis][i] = face.c[axis];
    }
    packet.length[i] = std::sqrt(longest_edge2(face));
    packet.blur[i] = rounding_blur(face);
  }
  return packet;
}

void set_box(FacePackets::Boxes& boxes, int i, const FacePackets::Packet& packet) {
  boxes.blur[i] = *std::ranges::max_element(packet.blur);
  // A face that rounding may put anywhere (or that is not finite) is looked at from everywhere.
  const bool boundless = !(boxes.blur[i] < kInfinity);
  boxes.length[i] = boundless ? 1 : *std::ranges::max_element(packet.length);
  for (int axis = 0; axis < 3; ++axis) {
    boxes.low[axis][i] = -kInfinity;
    boxes.high[axis][i] = kInfinity;
    if (boundless) continue;
    const auto [low_a, high_a] = std::ranges::minmax(packet.a[axis]);
    const auto [low_b, high_b] = std::ranges::minmax(packet.b[axis]);
    const auto [low_c, high_c] = std::ranges::minmax(packet.c[axis]);
    boxes.low[axis][i] = std::min({low_a, low_b, low_c});
    boxes.high[axis][i] = std::max({high_a, high_b, high_c});
  }
}

FacePackets::Boxes boxes_of_none() {
  FacePackets::Boxes boxes;
  for (int i = 0; i < FacePackets::kBoxes; ++i) {
    for (int axis = 0; axis < 3; ++axis) boxes.low[axis][i] = boxes.high[axis][i] = kFar;
    boxes.length[i] = boxes.blur[i] = 0;
  }
  return boxes;
}

}  // namespace

float rounding_blur(const Surface::Face& face) {
  const float length2 = longest_edge2(face);
  const float height2 = (face.b - face.a).cross(face.c - face.a).squaredNorm() / length2;
  // Below this share the height itself is rounding.
  if (!(height2 > 1e-10f * length2) || length2 == kInfinity) return kInfinity;
  // The areas are wrong by a share of 8 * 2^-24 (D / height)^2, which puts the closest point outside by at most
  // four times that share of the length.
  constexpr float kAreas = 8 * 0x1p-24f;
  return 2 * 4 * kAreas * std::sqrt(length2) / height2;
}

void FacePackets::assign(std::span<const Surface::Face> faces) {
  order_.clear();
  middles_.clear();
  packets.clear();
  boxes.clear();
  slack = 0;
  for (const Surface::Face& face : faces) {
    const Eigen::Vector3f middle = (face.a + face.b + face.c) / 3;
    order_.push_back(static_cast<int32_t>(order_.size()));
    middles_.push_back(middle.allFinite() ? middle : Eigen::Vector3f::Zero());  // what is not finite has no order
    slack = std::max(slack, middles_.back().lpNorm<Eigen::Infinity>());
  }
  slack *= 1e-6f;  // a few roundings of the largest coordinate
  sort_into_packets(order_, middles_);
  const std::span<const int32_t> order(order_);
  for (size_t first = 0; first < order.size(); first += kFaces) {
    const std::span<const int32_t> some = order.subspan(first, std::min<size_t>(kFaces, order.size() - first));
    const int place = static_cast<int>(packets.size()) % kBoxes;
    if (place == 0) boxes.push_back(boxes_of_none());
    packets.push_back(make_packet(some, faces));
    set_box(boxes.back(), place, packets.back());
  }
}

}  // namespace glovebench
