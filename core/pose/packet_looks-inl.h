// What a search knows of the packets of a color, and what a point is to remember of it.
// Included once for each instruction set (Highway); the guard turns with it.
#if defined(GLOVEBENCH_CORE_POSE_PACKET_LOOKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GLOVEBENCH_CORE_POSE_PACKET_LOOKS_INL_H
#undef GLOVEBENCH_CORE_POSE_PACKET_LOOKS_INL_H
#else
#define GLOVEBENCH_CORE_POSE_PACKET_LOOKS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "core/pose/closest_on_faces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glovebench::HWY_NAMESPACE {

template <typename V>
HWY_INLINE V outside(V at, const float* low, const float* high) {
  const V below = hn::Sub(hn::Load(kBoxFloats, low), at), above = hn::Sub(at, hn::Load(kBoxFloats, high));
  return hn::Max(hn::Zero(kBoxFloats), hn::Max(below, above));
}

/// For each packet how near its faces can be to the point: its box's distance less the same doubt.
HWY_INLINE void bound_packets(const Eigen::Vector3f& p, const FacePackets& color, PacketLook* looks) {
  const auto x = hn::Set(kBoxFloats, p.x()), y = hn::Set(kBoxFloats, p.y()), z = hn::Set(kBoxFloats, p.z());
  const auto share = hn::Set(kBoxFloats, kShare), slack = hn::Set(kBoxFloats, color.slack);
  for (const FacePackets::Boxes& boxes : color.boxes) {
    for (size_t i = 0; i < FacePackets::kBoxes; i += hn::Lanes(kBoxFloats)) {
      const auto dx = outside(x, boxes.low[0] + i, boxes.high[0] + i);
      const auto dy = outside(y, boxes.low[1] + i, boxes.high[1] + i);
      const auto dz = outside(z, boxes.low[2] + i, boxes.high[2] + i);
      const auto distance = hn::Sqrt(hn::Add(hn::Mul(dx, dx), hn::Add(hn::Mul(dy, dy), hn::Mul(dz, dz))));
      const auto in_doubt = doubt(distance, hn::Load(kBoxFloats, boxes.length + i),
                                  hn::Load(kBoxFloats, boxes.blur + i), slack, share);
      hn::Store(hn::Sub(distance, in_doubt), kBoxFloats, looks->bounds + i);
    }
    (looks++)->visited = 0;
  }
}

/// The packets of some boxes, a bit each, whose bounds are not above the limit.
HWY_INLINE uint32_t not_above(const float* bounds, float limit) {
  const auto above = hn::Gt(hn::Load(kBoxFloats, bounds), hn::Set(kBoxFloats, limit));
  uint8_t bits[8] = {};  // StoreMaskBits may write eight bytes
  hn::StoreMaskBits(kBoxFloats, hn::Not(above), bits);
  return bits[0] | uint32_t{bits[1]} << 8;
}

/// The faces that are near a point: what its memory will hold.
class FaceList {
 public:
  explicit FaceList(float near) : near_(near) {}

  /// Adds the faces of a packet that are near; those added first are the last to fall off.
  HWY_INLINE void add(const FacePackets& color, int packet, const PacketLook* looks) {
    const FacePlanes& planes = looks[packet / FacePackets::kBoxes].planes[packet % FacePackets::kBoxes];
    const Floats near = hn::Set(kFloats, near_);
    for (size_t first = 0; first < FacePackets::kFaces; first += hn::Lanes(kFloats)) {
      const Floats in_doubt = doubt(near, color.packets[packet], first, color.slack);
      const Floats distance = hn::Sub(hn::Load(kFloats, planes.distance + first), in_doubt);
      const Mask far = hn::Gt(distance, near), is_near = hn::Not(far);
      others_beyond_ = hn::Min(others_beyond_, hn::IfThenElse(far, distance, hn::Set(kFloats, kInfinity)));
      for (int axis = 0; axis < 3; ++axis)
        hn::CompressStore(hn::Load(kFloats, planes.normal[axis] + first), is_near, kFloats, normal_[axis] + count_);
      hn::CompressStore(hn::Add(hn::Load(kFloats, planes.offset + first), in_doubt), is_near, kFloats,
                        offset_ + count_);
      hn::CompressStore(distance, is_near, kFloats, distance_ + count_);
      const Ints places = hn::Iota(kInts, static_cast<int32_t>(packet * FacePackets::kFaces + first));
      hn::CompressStore(places, hn::RebindMask(kInts, is_near), kInts, place_ + count_);
      count_ += hn::CountTrue(kFloats, is_near);
    }
    for (; count_ > PointMemory::kFaces; --count_) {
      // What is not a number bounds nothing.
      const float distance = distance_[count_ - 1] >= -kInfinity ? distance_[count_ - 1] : -kInfinity;
      others_beyond_ = hn::Min(others_beyond_, hn::Set(kFloats, distance));
    }
  }
  /// Returns what all other faces of the packets that were added are at least away.
  HWY_INLINE float copy_to(PointMemory& memory) const {
    for (size_t first = 0; first < PointMemory::kFaces; first += hn::Lanes(kListFloats)) {
      const auto none = hn::Zero(kListFloats), never_nearest = hn::Set(kListFloats, -kInfinity);
      const auto taken = hn::FirstN(kListFloats, count_ > first ? count_ - first : 0);
      const auto copy = [&](const float* from, float* to, auto filling) {
        hn::Store(hn::IfThenElse(taken, hn::Load(kListFloats, from + first), filling), kListFloats, to + first);
      };
      for (int axis = 0; axis < 3; ++axis) copy(normal_[axis], memory.normal[axis], none);
      copy(offset_, memory.offset, never_nearest);
      const auto places = hn::Load(kListInts, place_ + first);
      hn::Store(hn::IfThenElseZero(hn::RebindMask(kListInts, taken), places), kListInts, memory.place + first);
    }
    return hn::GetLane(hn::MinOfLanes(kFloats, others_beyond_));
  }

 private:
  static constexpr int kCapacity = PointMemory::kFaces + 2 * FacePackets::kFaces;

  float near_;
  Floats others_beyond_ = hn::Set(kFloats, kInfinity);
  size_t count_ = 0;
  alignas(64) float normal_[3][kCapacity], offset_[kCapacity], distance_[kCapacity];
  alignas(64) int32_t place_[kCapacity];
};

}  // namespace glovebench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
