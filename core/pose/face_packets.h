#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/pose/closest_point.h"

namespace glovebench {

/// The faces of one color in packets of neighbors, laid out for SIMD: what the fast closest-point search reads.
struct FacePackets {
  static constexpr int kFaces = 8;
  /// Boxes that lie together: the most lanes of any instruction set.
  static constexpr int kBoxes = 16;

  /// Corners of each face, [axis][face]. A packet that is not full repeats its last face.
  struct alignas(64) Packet {
    float a[3][kFaces], b[3][kFaces], c[3][kFaces];
    int32_t face[kFaces];  ///< in Surface::faces
    float length[kFaces];  ///< of the longest edge
    float blur[kFaces];    ///< 1/m: see `rounding_blur`
  };
  /// Bounds of the packets, [axis][packet]. Behind the last packet they are very far away.
  struct alignas(64) Boxes {
    float low[3][kBoxes], high[3][kBoxes];
    float length[kBoxes], blur[kBoxes];  ///< the largest
  };

  RecycledVector<Packet> packets;
  RecycledVector<Boxes> boxes;
  float slack = 0;  ///< m: what rounding may move a corner, seen from anywhere

  /// Made anew from these faces; keeps its memory.
  void assign(std::span<const Surface::Face> faces);

 private:
  RecycledVector<int32_t> order_;  ///< of the faces; reused by `assign`
  RecycledVector<Eigen::Vector3f> middles_;
};

/// In single precision the closest point of a thin face may come to lie outside of it: for a point at most D away
/// by up to blur * D^2. That takes the rounding error of the areas in `closest_on_triangle` for 8 * 2^-24 (length *
/// D)^2: not the worst case, but several times what independent roundings add up to; and it is doubled, since
/// points move between two looks. Infinite for a face without an area.
float rounding_blur(const Surface::Face& face);

}  // namespace glovebench
