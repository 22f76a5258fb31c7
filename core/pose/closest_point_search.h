#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/pose/closest_point.h"
#include "core/pose/face_packets.h"

namespace glovebench {

/// What a point remembers of its last search over all packets.
struct PacketMemory {
  static constexpr int kPackets = 6;
  static constexpr float kNear = 0.002f;  ///< m: farther than the nearest face, packets are not worth a place

  Eigen::Vector3f p_hand = Eigen::Vector3f::Zero();  ///< where it was then
  float others_beyond = 0;  ///< the faces of the packets that are not listed are at least this far from p_hand, m
  int count = 0;            ///< of the listed packets; the first has the closest face
  int packets[kPackets] = {};
  float bounds[kPackets] = {};  ///< their faces are at least this far from p_hand, m
};

/// How near a point the faces of some packets can be, m.
struct alignas(64) PacketBounds {
  float bounds[FacePackets::kBoxes];
};

/// The answer of `closest_points_plain`, bit for bit and on every instruction set (on very thin faces as far as
/// `rounding_blur` bounds their rounding), faster, for points that move little from call to call. Packets of
/// neighboring faces are measured together (Highway); a packet whose box is farther than the nearest face so far is
/// passed over; and a point looks at the few packets near it alone while it has moved less than would bring any
/// other one nearer. One object follows one set of points on one surface; it keeps its buffers, and after the first
/// call nothing is allocated.
class ClosestPointSearch {
 public:
  ClosestPointSearch() = default;
  explicit ClosestPointSearch(const Surface& surface) { start(surface); }
  /// The points forget where they were: another surface, or others of its faces. The surface is copied.
  void start(const Surface& surface);
  /// Valid until the next call.
  const std::vector<ClosestPoint>& operator()(std::span<const LabeledPoint> points_hand);

 private:
  std::array<FacePackets, kColorCount + 1> colors_;
  std::vector<PacketMemory> memory_;
  std::vector<PacketBounds> bounds_;  ///< of the packets of one color from one point; reused
  std::vector<ClosestPoint> closest_;
};

}  // namespace glovebench
