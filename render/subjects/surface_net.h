#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace glovebench::render {

/// Triangles, counter-clockwise seen from outside.
struct SurfaceNet {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
};

/// Has every edge one triangle on each side?
bool is_closed(std::span<const std::array<uint32_t, 3>> triangles);

/// The surface where a field is zero (negative inside), by naive surface nets: a vertex in each cell of a grid that
/// the surface crosses, a quad for each edge of the grid that it crosses. The net is closed: each of its edges has
/// two triangles. `cell` is the grid's step, m; if two sheets meet in a cell, the grid is made 5% finer. The box
/// must hold the whole surface.
SurfaceNet polygonize_field(const std::function<double(const Eigen::Vector3d&)>& field,
                            const Eigen::AlignedBox3d& box, double cell);

}  // namespace glovebench::render
