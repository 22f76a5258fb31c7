#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include "bench/peers/peers.h"

namespace glovebench::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<float>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 to_cgal(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }
Eigen::Vector3f from_cgal(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

struct ColorTree {
  explicit ColorTree(const RecycledVector<Surface::Face>& faces) {
    for (const Surface::Face& face : faces)
      triangles.emplace_back(to_cgal(face.a), to_cgal(face.b), to_cgal(face.c));
    tree.insert(triangles.begin(), triangles.end());
    tree.do_not_accelerate_distance_queries();  // they come with a hint
    tree.build();
  }
  Triangles triangles;
  Tree tree;
};

class CgalSearch : public ClosestPointPeer {
 public:
  explicit CgalSearch(const Surface& surface) : surface_(surface) {
    for (uint8_t label = 0; label <= kColorCount; ++label)
      colors_.push_back(std::make_unique<ColorTree>(surface.faces(label)));
  }

  const RecycledVector<ClosestPoint>& operator()(std::span<const LabeledPoint> points_hand) override {
    closest_.resize(points_hand.size());
    WarmStart warm_start;
    for (size_t i = 0; i < points_hand.size(); ++i) {
      const LabeledPoint& point = points_hand[i];
      const ColorTree& color = *colors_[point.label];
      closest_[i] =
          color.tree.empty() ? ClosestPoint{} : find(point, color, warm_start(point, closest_[i], surface_));
      warm_start.found(point, closest_[i]);
    }
    return closest_;
  }

 private:
  static ClosestPoint find(const LabeledPoint& point, const ColorTree& color, const ClosestPoint& start) {
    const auto found = start.face < 0
                           ? color.tree.closest_point_and_primitive(to_cgal(point.p))
                           : color.tree.closest_point_and_primitive(
                                 to_cgal(point.p), {to_cgal(start.p_hand), color.triangles.begin() + start.face});
    const Eigen::Vector3f p = from_cgal(found.first);
    return {p, (p - point.p).norm(), static_cast<int>(found.second - color.triangles.begin())};
  }

  const Surface& surface_;
  std::vector<std::unique_ptr<ColorTree>> colors_;  ///< one a label
  RecycledVector<ClosestPoint> closest_;
};

}  // namespace

const MakeClosestPointPeer kCgal = make_search<CgalSearch>;

}  // namespace glovebench::bench
