#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

namespace glovebench::render {

/// A tapered capsule: all balls with centers on a line segment whose radius changes linearly along it, m.
struct Capsule {
  Eigen::Vector3d a;
  Eigen::Vector3d b;
  double radius_a = 0;
  double radius_b = 0;
};

/// How softly a capsule joins others.
enum class Joining : uint8_t {
  palm,    ///< parts of the palm and the forearm, with each other
  segment  ///< segments of fingers, with each other and with the palm as a whole
};

/// One capsule of a smooth union.
struct UnionPart {
  uint8_t capsule = 0;
  Joining joining = Joining::segment;
  float share = 1;  ///< 0: not in the union, 1: fully
};

/// A field's value (m, negative inside) and its gradient.
struct FieldSample {
  double value = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

/// Signed distance from a capsule.
FieldSample distance_to(const Capsule& capsule, const Eigen::Vector3d& p);

/// The smooth union of distances d_i with shares s_i: -k log sum s_i exp(-d_i / k), with k = 5 mm inside the palm
/// and 1.5 mm between palm and segments. Its value never exceeds the smallest distance of a full part.
FieldSample smooth_union(std::span<const Capsule> capsules, std::span<const UnionPart> parts,
                         const Eigen::Vector3d& p);

/// k of the union between segments, m.
inline constexpr double kSegmentJoining = 0.0015;
/// k of the union inside the palm, m.
inline constexpr double kPalmJoining = 0.005;

/// Moves a point along the gradient to where the field has this value. Newton's method with at most 24
/// steps of at most 3 mm; in a sharp crease it may stay short of it.
Eigen::Vector3d project_to_level(std::span<const Capsule> capsules, std::span<const UnionPart> parts, double level,
                                 Eigen::Vector3d p);

}  // namespace glovebench::render
