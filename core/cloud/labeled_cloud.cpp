#include "core/cloud/labeled_cloud.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/base/error.h"
#include "core/base/image.h"

namespace glovebench {
namespace {

/// Disjoint sets over 0..count-1; the root of a set is its smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0); }

  int root(int i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  void unite(int a, int b) {
    a = root(a);
    b = root(b);
    if (a < b)
      parents_[b] = a;
    else
      parents_[a] = b;
  }

 private:
  RecycledVector<int> parents_;
};

/// For each point the index of the first point (in row-major order) of its component.
RecycledVector<int> component_roots(const LabeledCloud& cloud, double depth_step) {
  const int width = cloud.labels.width();
  DisjointSets sets(cloud.points.size());
  // Point indices of the row above and of this one, -1 where there is none, with a margin at both ends.
  RecycledVector<int> above(width + 2, -1), current(width + 2, -1);
  int next = 0;
  for (int v = 0; v < cloud.labels.height(); ++v) {
    std::swap(above, current);
    std::fill(current.begin(), current.end(), -1);
    for_each_nonzero(cloud.labels, v, [&](int u) {
      const int point = next++;
      current[u + 1] = point;
      for (int neighbor : {current[u], above[u], above[u + 1], above[u + 2]})
        if (neighbor >= 0 && std::abs(cloud.points[neighbor].p.z() - cloud.points[point].p.z()) <= depth_step)
          sets.unite(neighbor, point);
    });
  }
  check(next == static_cast<int>(cloud.points.size()), "a cloud has one point for each labeled pixel");
  RecycledVector<int> roots(cloud.points.size());
  for (int i = 0; i < next; ++i) roots[i] = sets.root(i);
  return roots;
}

/// Number of points of each component, at the index of its root; 0 elsewhere.
RecycledVector<int> sizes_by_root(const RecycledVector<int>& roots) {
  RecycledVector<int> sizes(roots.size(), 0);
  for (int root : roots) ++sizes[root];
  return sizes;
}

}  // namespace

LabeledCloud build_cloud(const DepthImage& depth, const LabelImage& labels, const PinholeCamera& camera,
                         const WorkingVolume& volume) {
  check(depth.width() == labels.width() && depth.height() == labels.height(),
        "depth and labels are images of one camera");
  LabeledCloud cloud;
  cloud.labels = LabelImage(labels.width(), labels.height());
  for (int v = 0; v < labels.height(); ++v) {
    const float* const depths = depth.row(v);
    const uint8_t* const found = labels.row(v);
    uint8_t* const kept = cloud.labels.row(v);
    for_each_nonzero(labels, v, [&](int u) {
      const double z = depths[u];
      if (!(z > 0)) return;
      if (z < volume.z_min || z > volume.z_max) {
        ++cloud.labeled_outside;
        cloud.labeled_cut_off += z > volume.z_min - kCutOffMargin && z < volume.z_max + kCutOffMargin;
        return;
      }
      kept[u] = found[u];
      cloud.points.push_back({camera.back_project(u, v, z).cast<float>(), found[u]});
    });
  }
  return cloud;
}

RecycledVector<int> component_sizes(const LabeledCloud& cloud, double depth_step) {
  RecycledVector<int> sizes = sizes_by_root(component_roots(cloud, depth_step));
  std::erase(sizes, 0);
  std::sort(sizes.begin(), sizes.end(), std::greater<>());
  return sizes;
}

LabeledCloud largest_component(const LabeledCloud& cloud, double depth_step) {
  const RecycledVector<int> roots = component_roots(cloud, depth_step);
  const RecycledVector<int> sizes = sizes_by_root(roots);
  const int largest = static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());

  LabeledCloud kept;
  kept.labels = cloud.labels;
  kept.labeled_outside = cloud.labeled_outside;
  kept.labeled_cut_off = cloud.labeled_cut_off;
  size_t point = 0;
  for (int v = 0; v < kept.labels.height(); ++v) {
    for_each_nonzero(cloud.labels, v, [&](int u) {
      if (roots[point] == largest)
        kept.points.push_back(cloud.points[point]);
      else
        kept.labels(u, v) = 0;
      ++point;
    });
  }
  return kept;
}

}  // namespace glovebench
