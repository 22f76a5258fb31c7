#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/pose/closest_point.h"

namespace glovebench {

/// Boxes with what says how far rounding may put closest points outside of them; side by side, for SIMD.
template <int kCount>
struct alignas(64) Boxes {
  float low[3][kCount], high[3][kCount];  ///< [axis][box], m
  float length[kCount];                   ///< of the longest edge of a face, m
  float blur[kCount];                     ///< 1/m: see `rounding_blur`
};

/// The faces of one color in packets of neighbors: what the fast closest-point search reads.
struct FacePackets {
  static constexpr int kFaces = 8;     ///< in a packet
  static constexpr int kPackets = 16;  ///< whose boxes lie together: the most lanes of any instruction set

  /// One cache line.
  struct alignas(64) Face {
    float a[3], b[3], c[3];
    float ab[3], ac[3];  ///< b - a, c - a
    int32_t face;        ///< in Surface::faces
  };

  RecycledVector<Face> faces;                    ///< whole packets: the last one repeats its last face
  RecycledVector<Boxes<kFaces>> face_boxes;      ///< a packet each; what repeats a face is very far away
  RecycledVector<Boxes<kPackets>> packet_boxes;  ///< behind the last packet they are very far away
  RecycledVector<int32_t> place;                 ///< in `faces`, of each of Surface::faces
  float slack = 0;                               ///< m: what rounding may move a corner, seen from anywhere

  int packet_count() const { return static_cast<int>(face_boxes.size()); }
  /// Made anew of these faces; `order`, less `first_index`, lists them so that neighbors come together. Keeps its
  /// memory.
  void assign(std::span<const Surface::Face> surface_faces, std::span<const uint32_t> order, uint32_t first_index);
};

/// In single precision the closest point of a thin face may come to lie outside of it: for a point at most D away
/// by up to blur * D^2. That takes the rounding error of the areas in `closest_on_triangle` for 8 * 2^-24 (length *
/// D)^2: not the worst case, but several times what independent roundings add up to; and it is doubled. Infinite
/// for a face without an area.
float rounding_blur(const Surface::Face& face);

}  // namespace glovebench
