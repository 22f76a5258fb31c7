#include "core/pose/closest_point.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace glovebench {

namespace {

struct Best {
  Eigen::Vector3f p = Eigen::Vector3f::Zero();
  float squared = std::numeric_limits<float>::infinity();
  int face = -1;

  /// Of equally close faces the first wins.
  void consider(const Eigen::Vector3f& point, const RecycledVector<Surface::Face>& faces, int f) {
    const Eigen::Vector3f candidate = closest_on_triangle(point, faces[f]);
    const float d = (candidate - point).squaredNorm();
    if (d < squared) {
      p = candidate;
      squared = d;
      face = f;
    }
  }
  ClosestPoint result() const {
    if (face < 0) return {};
    return {p, std::sqrt(squared), face};
  }
};

/// Positive if the face looks at the viewpoint: twice the area that is seen from there, times the distance.
float facing(const Surface::Face& face, const Eigen::Vector3f& viewpoint) {
  return (face.b - face.a).cross(face.c - face.a).dot(viewpoint - face.a);
}

}  // namespace

void Surface::assign(const HandModel& model, const PosedHand& hand, const Eigen::Vector3f& viewpoint_hand,
                     Coloring coloring) {
  for (RecycledVector<Face>& faces : faces_) faces.clear();
  const Eigen::Vector3f* const vertices = hand.vertices.data();  // a model names none that it lacks
  uint32_t next = 0;
  for (const Triangle& triangle : model.triangles()) {
    const Face face{vertices[triangle.vertices[0]], vertices[triangle.vertices[1]], vertices[triangle.vertices[2]],
                    next++};
    if (facing(face, viewpoint_hand) <= 0) continue;
    faces_[coloring == Coloring::by_color ? triangle.label : kAnyColor].push_back(face);
  }
}

Eigen::Vector3f seen_center(const HandModel& model, const PosedHand& hand, const Eigen::Vector3f& viewpoint_hand) {
  Eigen::Vector3d weighted = Eigen::Vector3d::Zero();
  double total = 0;
  for (const Triangle& triangle : model.triangles()) {
    const auto& [a, b, c] = triangle.vertices;
    const Surface::Face face{hand.vertices[a], hand.vertices[b], hand.vertices[c], 0};
    const float toward = facing(face, viewpoint_hand);
    if (toward <= 0) continue;
    const double area = toward / (viewpoint_hand - face.a).norm();
    weighted += area * ((face.a + face.b + face.c) / 3).cast<double>();
    total += area;
  }
  return total > 0 ? Eigen::Vector3f((weighted / total).cast<float>()) : Eigen::Vector3f::Zero();
}

bool Surface::empty() const {
  return std::all_of(faces_.begin(), faces_.end(), [](const RecycledVector<Face>& faces) { return faces.empty(); });
}

Eigen::Vector3f closest_on_triangle(const Eigen::Vector3f& p, const Surface::Face& face) {
  const Eigen::Vector3f ab = face.b - face.a, ac = face.c - face.a, ap = p - face.a;
  const float d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return face.a;
  const Eigen::Vector3f bp = p - face.b;
  const float d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return face.b;
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return face.a + d1 / (d1 - d3) * ab;
  const Eigen::Vector3f cp = p - face.c;
  const float d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return face.c;
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return face.a + d2 / (d2 - d6) * ac;
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return face.b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (face.c - face.b);
  const float scale = 1 / (va + vb + vc);
  return face.a + ab * (vb * scale) + ac * (vc * scale);
}

RecycledVector<ClosestPoint> closest_points_plain(std::span<const LabeledPoint> points_hand,
                                                  const Surface& surface) {
  RecycledVector<ClosestPoint> result;
  result.reserve(points_hand.size());
  for (const LabeledPoint& point : points_hand) {
    const RecycledVector<Surface::Face>& faces = surface.faces(point.label);
    Best best;
    for (int f = 0; f < static_cast<int>(faces.size()); ++f) best.consider(point.p, faces, f);
    result.push_back(best.result());
  }
  return result;
}

}  // namespace glovebench
