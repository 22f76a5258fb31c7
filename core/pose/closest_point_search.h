#pragma once

#include <array>
#include <span>

#include "core/pose/closest_point.h"
#include "core/pose/face_packets.h"

namespace glovebench {

/// What a point remembers of its last search over all packets: faces that are near, each with a plane behind which
/// it lies, `normal` being of unit length towards the point. As far as rounding can be trusted, the face is at
/// least normal * p - offset away from any p that is up to `reach` from its nearest face, m.
struct alignas(64) PointMemory {
  static constexpr int kFaces = 16;
  static constexpr float kNear = 0.002f;   ///< m: farther than the nearest face, others are not worth a place
  static constexpr float kStays = 0.004f;  ///< m: what moves farther than this will go on moving

  float normal[3][kFaces] = {}, offset[kFaces] = {};
  int32_t place[kFaces] = {};                        ///< in the packets
  Eigen::Vector3f p_hand = Eigen::Vector3f::Zero();  ///< where it was then
  float others_beyond = 0;                           ///< all other faces are at least this far from p_hand, m
  float reach = 0;
  int nearest = -1;   ///< the place of the closest face, also of later looks; -1 if there is none
  uint8_t label = 0;  ///< whose packets these are
};

/// Of the faces of a packet that was visited.
struct alignas(64) FacePlanes {
  float normal[3][FacePackets::kFaces], offset[FacePackets::kFaces];  ///< as in PointMemory
  float distance[FacePackets::kFaces];                                ///< at least, m
};
/// What a search of one point knows of some packets.
struct alignas(64) PacketLook {
  float bounds[FacePackets::kBoxes];  ///< how near the faces of a packet that was not visited can be, m
  FacePlanes planes[FacePackets::kBoxes];
  uint32_t visited;  ///< a bit each
};

/// The answer of `closest_points_plain`, bit for bit and on every instruction set (on very thin faces as far as
/// `rounding_blur` bounds their rounding), faster, for points that move little from call to call. Packets of
/// neighboring faces are measured together (Highway); a packet whose box is farther than the nearest face so far is
/// passed over; and while a point has moved less than would bring another packet nearer, it measures the faces of
/// those near it alone that their planes do not rule out: few more than one. One object follows one set of points
/// on one surface; it keeps its buffers, and after the first call nothing is allocated.
class ClosestPointSearch {
 public:
  ClosestPointSearch() = default;
  explicit ClosestPointSearch(const Surface& surface) { start(surface); }
  /// The points forget where they were: another surface, or others of its faces. The surface is copied.
  void start(const Surface& surface);
  /// Valid until the next call.
  const RecycledVector<ClosestPoint>& operator()(std::span<const LabeledPoint> points_hand);

 private:
  std::array<FacePackets, kColorCount + 1> colors_;
  RecycledVector<PointMemory> memory_;
  RecycledVector<PacketLook> looks_;  ///< of one point at the packets of its color; reused
  RecycledVector<ClosestPoint> closest_;
};

}  // namespace glovebench
