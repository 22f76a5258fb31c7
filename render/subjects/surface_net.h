#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace glovebench::render {

/// Counter-clockwise from outside.
struct SurfaceNet {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
};

/// True if each edge has two triangles.
bool is_closed(std::span<const std::array<uint32_t, 3>> triangles);

/// The field's zero surface (negative inside) as closed naive surface nets. The field's slope is at most 1: it is
/// not computed where a neighbor is far from the surface. `cell`: grid step, m; 5% finer while two sheets meet in a
/// cell. `box` must hold the surface.
SurfaceNet polygonize_field(const std::function<double(const Eigen::Vector3d&)>& field,
                            const Eigen::AlignedBox3d& box, double cell);

}  // namespace glovebench::render
