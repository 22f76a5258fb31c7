#include "core/pose/closest_point.h"

#include <Eigen/Geometry>
#include <limits>

namespace glovebench {

namespace {

// Single-precision rounding at hand size: far below any distance that matters, far above an ulp at 0.2 m (1.5e-8).
constexpr float kSlack = 1e-6f;

/// Neighboring faces that the search passes over together.
constexpr int kBlock = 16;

/// Halves a block again and again: pairs of values, not a chain of them, so that registers of four are used.
float smallest_of_block(const float* values) {
  std::array<float, kBlock / 2> smaller;
  for (int i = 0; i < kBlock / 2; ++i) smaller[i] = std::min(values[i], values[i + kBlock / 2]);
  for (int i = 0; i < kBlock / 4; ++i) smaller[i] = std::min(smaller[i], smaller[i + kBlock / 4]);
  return std::min(std::min(smaller[0], smaller[1]), std::min(smaller[2], smaller[3]));
}

struct Best {
  Eigen::Vector3f p = Eigen::Vector3f::Zero();
  float squared = std::numeric_limits<float>::infinity();
  int face = -1;
  float last = 0;  // distance of the face tried last

  /// Equally close faces: the first wins, in whatever order they are tried.
  void consider(const Eigen::Vector3f& point, const std::vector<Surface::Face>& faces, int f) {
    const Eigen::Vector3f candidate = closest_on_triangle(point, faces[f]);
    const float d = (candidate - point).squaredNorm();
    if (d < squared || (d == squared && f < face)) {
      p = candidate;
      squared = d;
      face = f;
    }
    last = std::sqrt(d);
  }
  ClosestPoint result() const {
    if (face < 0) return {};
    return {p, std::sqrt(squared), face};
  }
};

}  // namespace

Surface::Surface(const HandModel& model, const PosedHand& hand, const Eigen::Vector3f& viewpoint_hand,
                 Coloring coloring) {
  Eigen::Vector3d weighted = Eigen::Vector3d::Zero();
  double total = 0;
  for (uint32_t t = 0; t < model.triangles().size(); ++t) {
    const Triangle& triangle = model.triangles()[t];
    const Face face{hand.vertices[triangle.vertices[0]], hand.vertices[triangle.vertices[1]],
                    hand.vertices[triangle.vertices[2]], t};
    const Eigen::Vector3f normal = (face.b - face.a).cross(face.c - face.a);
    const Eigen::Vector3f to_viewer = viewpoint_hand - face.a;
    const float facing = normal.dot(to_viewer);
    if (facing <= 0) continue;
    Color& color = colors_[coloring == Coloring::by_color ? triangle.label : kAnyColor];
    color.faces.push_back(face);
    const Eigen::Vector3f middle = (face.a + face.b + face.c) / 3;
    const float radius = std::sqrt(std::max(
        {(face.a - middle).squaredNorm(), (face.b - middle).squaredNorm(), (face.c - middle).squaredNorm()}));
    color.x.push_back(middle.x());
    color.y.push_back(middle.y());
    color.z.push_back(middle.z());
    color.radius.push_back(radius * 1.0001f + 1e-7f);  // never below the true one after rounding
    const double area = facing / to_viewer.norm();
    weighted += area * middle.cast<double>();
    total += area;
  }
  if (total > 0) center_ = (weighted / total).cast<float>();
}

bool Surface::empty() const {
  return std::all_of(colors_.begin(), colors_.end(), [](const Color& c) { return c.faces.empty(); });
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
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    return face.b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (face.c - face.b);
  }
  const float scale = 1 / (va + vb + vc);
  return face.a + ab * (vb * scale) + ac * (vc * scale);
}

std::vector<ClosestPoint> closest_points_plain(std::span<const LabeledPoint> points_hand, const Surface& surface) {
  std::vector<ClosestPoint> result;
  result.reserve(points_hand.size());
  for (const LabeledPoint& point : points_hand) {
    const std::vector<Surface::Face>& faces = surface.faces(point.label);
    Best best;
    for (int f = 0; f < static_cast<int>(faces.size()); ++f) best.consider(point.p, faces, f);
    result.push_back(best.result());
  }
  return result;
}

std::vector<ClosestPoint> ClosestPointSearch::operator()(std::span<const LabeledPoint> points_hand) {
  memory_.resize(points_hand.size());
  std::vector<ClosestPoint> result;
  result.reserve(points_hand.size());
  for (size_t i = 0; i < points_hand.size(); ++i) {
    const LabeledPoint& point = points_hand[i];
    Memory& memory = memory_[i];
    if (memory.face >= 0) {
      Best same;
      same.consider(point.p, surface_.faces(point.label), memory.face);
      const float moved = (point.p - memory.p_hand).norm();
      const ClosestPoint kept = same.result();
      if (kept.distance + kSlack < memory.others_beyond - moved) {
        result.push_back(kept);
        continue;
      }
    }
    result.push_back(search(point, memory));
  }
  return result;
}

ClosestPoint ClosestPointSearch::search(const LabeledPoint& point, Memory& memory) {
  const Surface::Color& color = surface_.colors_[point.label];
  const int count = static_cast<int>(color.faces.size());
  const Eigen::Vector3f& p = point.p;
  // Distances to the faces' bounding spheres; whole blocks at a time, with nothing behind the last face.
  const int blocks = (count + kBlock - 1) / kBlock;
  gap_.assign(static_cast<size_t>(blocks) * kBlock, std::numeric_limits<float>::infinity());
  for (int f = 0; f < count; ++f) {
    const float dx = color.x[f] - p.x(), dy = color.y[f] - p.y(), dz = color.z[f] - p.z();
    gap_[f] = std::sqrt(dx * dx + dy * dy + dz * dz) - color.radius[f];
  }
  Best best;
  float nearest = std::numeric_limits<float>::infinity(), second = nearest;  // of the distances or their bounds
  const auto try_face = [&](int f) {
    const float before = best.squared;
    best.consider(p, color.faces, f);
    const float d = best.last;
    if (best.face == f) {
      second = std::min(second, std::sqrt(before));
      nearest = d;
    } else {
      second = std::min(second, d);
    }
  };
  if (memory.face >= 0) try_face(memory.face);
  for (int block = 0; block < blocks; ++block) {
    // A face that cannot be nearest still bounds how far the point may move before it is looked at again.
    const float* const gap = &gap_[static_cast<size_t>(block) * kBlock];
    const float smallest = smallest_of_block(gap);
    if (smallest > nearest + kSlack) {
      second = std::min(second, smallest);
      continue;
    }
    for (int i = 0; i < kBlock; ++i) {
      const int f = block * kBlock + i;
      if (f == memory.face || f >= count) continue;
      if (gap[i] > nearest + kSlack) {
        second = std::min(second, gap[i]);
      } else {
        try_face(f);
      }
    }
  }
  memory = {p, best.face, second - kSlack};
  return best.result();
}

}  // namespace glovebench
