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

/// The faces of one color in packets of those that follow each other, which are neighbors in the mesh mostly: what
/// the fast closest-point search reads.
struct FacePackets {
  static constexpr int kFaces = 8;     ///< in a packet
  static constexpr int kPackets = 16;  ///< whose boxes lie together: the most lanes of any instruction set

  /// One cache line.
  struct alignas(64) Face {
    float a[3], b[3], c[3];
    float ab[3], ac[3];  ///< b - a, c - a
    int32_t face;        ///< in Surface::faces: its own place, but for what is repeated
  };

  RecycledVector<Face> faces;                    ///< as in Surface::faces; the last one is repeated: whole packets
  RecycledVector<Boxes<kFaces>> face_boxes;      ///< a packet each; what repeats a face is very far away
  RecycledVector<Boxes<kPackets>> packet_boxes;  ///< behind the last packet they are very far away
  float slack = 0;                               ///< m: what rounding may move a corner, seen from anywhere

  int packet_count() const { return static_cast<int>(face_boxes.size()); }
  /// Made anew of these faces; keeps its memory.
  void assign(std::span<const Surface::Face> surface_faces);
};

/// In single precision the closest point of a thin face may come to lie outside of it: for a point at most D away
/// by up to blur * D^2. That takes the rounding error of the areas in `closest_on_triangle` for 8 * 2^-24 (length *
/// D)^2: not the worst case, but several times what independent roundings add up to; and it is doubled. Infinite
/// for a face without an area.
float rounding_blur(const Surface::Face& face);

}  // namespace glovebench
