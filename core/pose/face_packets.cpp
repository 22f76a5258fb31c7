#include "core/pose/face_packets.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

namespace glovebench {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Place of padding boxes, m: very far, with a finite square.
constexpr float kFar = 1e18f;

/// A row for each face of a packet.
using Lanes = Eigen::Array<float, FacePackets::kFaces, 1>;
using LaneVectors = Eigen::Array<float, FacePackets::kFaces, 3>;

struct Corners {
  LaneVectors a, b, c;
};

Lanes squared_length(const LaneVectors& v) { return v.col(0).square() + v.col(1).square() + v.col(2).square(); }

Lanes squared_area(const LaneVectors& v, const LaneVectors& w) {
  LaneVectors cross;
  cross << v.col(1) * w.col(2) - v.col(2) * w.col(1), v.col(2) * w.col(0) - v.col(0) * w.col(2),
      v.col(0) * w.col(1) - v.col(1) * w.col(0);
  return squared_length(cross);
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

void set_boundless(Boxes<FacePackets::kFaces>& boxes, int i) {
  for (int axis = 0; axis < 3; ++axis) {
    boxes.low[axis][i] = -kInfinity;
    boxes.high[axis][i] = kInfinity;
  }
  boxes.length[i] = 1;
  boxes.blur[i] = kInfinity;
}

/// A face that is not finite, or has an infinite blur, gets an infinite box.
Boxes<FacePackets::kFaces> boxes_around(const Corners& faces) {
  const LaneVectors ab = faces.b - faces.a, ac = faces.c - faces.a;
  const Lanes length2 = squared_length(ab).max(squared_length(ac)).max(squared_length(faces.c - faces.b));
  const Lanes height2 = squared_area(ab, ac) / length2;
  // Areas have a relative error of 8 * 2^-24 (D / height)^2: not the worst case, but several times the sum of
  // independent roundings. It moves the closest point by at most four times this share of the length; doubled.
  constexpr float kAreas = 8 * 0x1p-24f;

  Boxes<FacePackets::kFaces> boxes;
  const auto lanes = [](float* values) { return Eigen::Map<Lanes, Eigen::Aligned16>(values); };
  // Eigen's square root depends on the processor.
  for (int i = 0; i < FacePackets::kFaces; ++i) boxes.length[i] = std::sqrt(length2[i]);
  lanes(boxes.blur) = 2 * 4 * kAreas * lanes(boxes.length) / height2;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = faces.a.col(axis), b = faces.b.col(axis), c = faces.c.col(axis);
    lanes(boxes.low[axis]) = a.min(b).min(c);
    lanes(boxes.high[axis]) = a.max(b).max(c);
  }
  // A smaller height is only rounding error.
  for (int i = 0; i < FacePackets::kFaces; ++i)
    if (!(height2[i] > 1e-10f * length2[i] && length2[i] < kInfinity)) set_boundless(boxes, i);
  return boxes;
}

/// Writes a value for box `i` from the values of other boxes.
template <int kTo, int kFrom>
void set_box_around(Boxes<kTo>& boxes, int i, const Boxes<kFrom>& others) {
  const auto all = [](const float* values) { return Eigen::Map<const Eigen::Array<float, kFrom, 1>>(values); };
  for (int axis = 0; axis < 3; ++axis) {
    boxes.low[axis][i] = all(others.low[axis]).minCoeff();
    boxes.high[axis][i] = all(others.high[axis]).maxCoeff();
  }
  boxes.length[i] = all(others.length).maxCoeff();
  boxes.blur[i] = all(others.blur).maxCoeff();
}

template <int kCount>
void set_nothing(Boxes<kCount>& boxes, int from) {
  for (int i = from; i < kCount; ++i) {
    for (int axis = 0; axis < 3; ++axis) boxes.low[axis][i] = boxes.high[axis][i] = kFar;
    boxes.length[i] = boxes.blur[i] = 0;
  }
}

}  // namespace

void FacePackets::assign(std::span<const Surface::Face> surface_faces) {
  faces.clear();
  face_boxes.clear();
  packet_boxes.clear();
  slack = 0;
  for (size_t first = 0; first < surface_faces.size(); first += kFaces) {
    const auto some = surface_faces.subspan(first, std::min<size_t>(kFaces, surface_faces.size() - first));
    Corners corners;
    for (size_t i = 0; i < kFaces; ++i) {
      const size_t index = std::min(i, some.size() - 1);
      const Surface::Face& face = some[index];
      faces.push_back(make_face(face, static_cast<int32_t>(first + index)));
      corners.a.row(i) = face.a.array();
      corners.b.row(i) = face.b.array();
      corners.c.row(i) = face.c.array();
    }
    const LaneVectors middle = ((corners.a + corners.b + corners.c) / 3).abs();
    for (const float coordinate : middle.reshaped())
      if (coordinate < kInfinity) slack = std::max(slack, coordinate);
    Boxes<kFaces>& boxes = face_boxes.emplace_back(boxes_around(corners));
    const int packet = static_cast<int>(first / kFaces) % kPackets;
    if (packet == 0) set_nothing(packet_boxes.emplace_back(), 0);
    set_box_around(packet_boxes.back(), packet, boxes);
    set_nothing(boxes, static_cast<int>(some.size()));
  }
  slack *= 1e-6f;  // a few roundings of the largest coordinate
}

}  // namespace glovebench
