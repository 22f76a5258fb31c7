#pragma once

#include <cstdint>
#include <span>

#include "core/pose/closest_point.h"

namespace glovebench {

/// Boxes for SIMD, with bounds of rounding.
template <int kCount>
struct alignas(64) Boxes {
  float low[3][kCount], high[3][kCount];  ///< [axis][box], m
  float length[kCount];                   ///< longest edge, m
  /// Rounding may place a thin face's closest point up to blur * D^2 outside it, at distance D. Infinite without
  /// area. 1/m
  float blur[kCount];
};

/// Faces of one color.
struct FacePackets {
  static constexpr int kFaces = 8;     ///< per packet
  static constexpr int kPackets = 16;  ///< per group

  struct alignas(64) Face {
    float a[3], b[3], c[3];
    float ab[3], ac[3];
    int32_t face;  ///< in Surface::faces
  };

  RecycledVector<Face> faces;                ///< padded with the last
  RecycledVector<Boxes<kFaces>> face_boxes;  ///< by packet; padding is very far
  RecycledVector<Boxes<kPackets>> packet_boxes;
  float slack = 0;  ///< rounding error of a corner, m

  int packet_count() const { return static_cast<int>(face_boxes.size()); }
  void assign(std::span<const Surface::Face> surface_faces);
};

}  // namespace glovebench
