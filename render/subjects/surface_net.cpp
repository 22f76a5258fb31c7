#include "render/subjects/surface_net.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "core/base/error.h"

namespace glovebench::render {
namespace {

using Index = Eigen::Vector3i;

/// Cells from the surface beyond which a node needs no exact value: an edge that crosses the surface is one cell
/// long.
constexpr double kFar = 1.001;

class SurfaceNetMaker {
 public:
  SurfaceNetMaker(const std::function<double(const Eigen::Vector3d&)>& field, const Eigen::AlignedBox3d& box,
                  double cell)
      : origin_(box.min()), cell_(cell), nodes_((box.sizes() / cell).array().ceil().cast<int>() + 2) {
    values_.reserve(static_cast<size_t>(nodes_.prod()));
    for_each_node([&](const Index& i) {
      const double bound = bound_of(i);
      values_.push_back(std::abs(bound) > kFar * cell_ ? bound : field(place(i.cast<double>())));
      const bool on_border = (i.array() == 0).any() || (i.array() == nodes_.array() - 1).any();
      check(!on_border || values_.back() > 0, "the box holds the whole surface");
    });
    vertex_of_cell_.assign(values_.size(), -1);
  }

  SurfaceNet make() {
    for_each_node([&](const Index& i) {
      if ((i.array() < nodes_.array() - 1).all()) add_vertex(i);
    });
    for_each_node([&](const Index& i) {
      for (int axis = 0; axis < 3; ++axis) {
        if (i[axis] + 1 < nodes_[axis]) add_quad(i, axis);
      }
    });
    return std::move(net_);
  }

 private:
  template <typename Visit>
  void for_each_node(const Visit& visit) const {
    for (int z = 0; z < nodes_.z(); ++z)
      for (int y = 0; y < nodes_.y(); ++y)
        for (int x = 0; x < nodes_.x(); ++x) visit(Index(x, y, z));
  }
  size_t number(const Index& i) const {
    return (static_cast<size_t>(i.z()) * nodes_.y() + i.y()) * nodes_.x() + i.x();
  }
  Eigen::Vector3d place(const Eigen::Vector3d& node) const { return origin_ + cell_ * node; }

  /// A value of the node's sign that is no farther from 0, as its neighbors before it tell; 0 if they do not.
  double bound_of(const Index& node) const {
    double bound = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (node[axis] == 0) continue;
      const double neighbor = values_[number(node - Index::Unit(axis))];
      const double least = std::abs(neighbor) - cell_;
      if (least > std::abs(bound)) bound = std::copysign(least, neighbor);
    }
    return bound;
  }

  /// The vertex of the cell whose lowest corner is this node: the mean of the crossings of its twelve edges.
  void add_vertex(const Index& lowest) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int crossings = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (int side = 0; side < 4; ++side) {
        Index from = lowest;
        from[(axis + 1) % 3] += side & 1;
        from[(axis + 2) % 3] += side >> 1;
        const double a = values_[number(from)], b = values_[number(from + Index::Unit(axis))];
        if ((a < 0) == (b < 0)) continue;
        sum += from.cast<double>() + a / (a - b) * Eigen::Vector3d::Unit(axis);
        ++crossings;
      }
    }
    if (crossings == 0) return;
    vertex_of_cell_[number(lowest)] = static_cast<int>(net_.vertices.size());
    net_.vertices.push_back(place(sum / crossings));
  }

  void add_quad(const Index& node, int axis) {
    const double a = values_[number(node)], b = values_[number(node + Index::Unit(axis))];
    if ((a < 0) == (b < 0)) return;
    const Index u = Index::Unit((axis + 1) % 3), v = Index::Unit((axis + 2) % 3);
    // Around the edge, counter-clockwise seen from its far end.
    std::array<uint32_t, 4> q;
    const std::array<Index, 4> cells = {node, node - u, node - u - v, node - v};
    for (int i = 0; i < 4; ++i) q[i] = static_cast<uint32_t>(vertex_of_cell_[number(cells[i])]);
    if (b < 0) std::swap(q[1], q[3]);
    const auto diagonal = [&](int i, int k) { return (net_.vertices[q[i]] - net_.vertices[q[k]]).squaredNorm(); };
    if (diagonal(0, 2) > diagonal(1, 3)) std::rotate(q.begin(), q.begin() + 1, q.end());
    net_.triangles.push_back({q[0], q[1], q[2]});
    net_.triangles.push_back({q[0], q[2], q[3]});
  }

  Eigen::Vector3d origin_;
  double cell_;
  Index nodes_;
  std::vector<double> values_;
  std::vector<int> vertex_of_cell_;
  SurfaceNet net_;
};

}  // namespace

bool is_closed(std::span<const std::array<uint32_t, 3>> triangles) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const auto& t : triangles)
    for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  return std::all_of(edges.begin(), edges.end(), [&edges](const auto& entry) {
    const auto& [edge, count] = entry;
    return count == 1 && edges.contains({edge.second, edge.first});
  });
}

SurfaceNet polygonize_field(const std::function<double(const Eigen::Vector3d&)>& field,
                            const Eigen::AlignedBox3d& box, double cell) {
  constexpr int kMostGrids = 10;
  for (int grid = 0; grid < kMostGrids; ++grid, cell *= 0.95) {
    SurfaceNet net = SurfaceNetMaker(field, box, cell).make();
    if (is_closed(net.triangles)) return net;
  }
  throw std::logic_error("broken invariant: one of ten grids keeps the sheets of a surface apart");
}

}  // namespace glovebench::render
