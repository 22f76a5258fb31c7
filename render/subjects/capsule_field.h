#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

namespace glovebench::render {

/// A segment with linear radius, m.
struct Capsule {
  Eigen::Vector3d a;
  Eigen::Vector3d b;
  double radius_a = 0;
  double radius_b = 0;
};

enum class Joining : uint8_t {
  palm,    ///< palm and forearm
  segment  ///< fingers, also with the palm
};

struct UnionPart {
  uint8_t capsule = 0;
  Joining joining = Joining::segment;
  float share = 1;  ///< 0: not in the union, 1: fully
};

/// Value (m, negative inside) and gradient.
struct FieldSample {
  double value = 0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

FieldSample distance_to(const Capsule& capsule, const Eigen::Vector3d& p);

/// -k log sum s_i exp(-d_i / k) of distances d_i and shares s_i, at most a full part's smallest distance.
FieldSample smooth_union(std::span<const Capsule> capsules, std::span<const UnionPart> parts,
                         const Eigen::Vector3d& p);

/// k of `smooth_union` between segments and palm, m.
inline constexpr double kSegmentJoining = 0.0015;
/// k inside the palm, m.
inline constexpr double kPalmJoining = 0.005;

/// Newton steps along the gradient to `level`. May stop short in creases.
Eigen::Vector3d project_to_level(std::span<const Capsule> capsules, std::span<const UnionPart> parts, double level,
                                 Eigen::Vector3d p);

}  // namespace glovebench::render
