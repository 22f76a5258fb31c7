#include "core/pose/closest_point_search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

// This file is compiled once for each instruction set, but not for those whose vectors have no size in a program.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/pose/closest_point_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/pose/closest_on_faces-inl.h"
#include "core/pose/packet_looks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glovebench::HWY_NAMESPACE {

/// The search of one point over the packets of its color. One that is to be remembered takes longer.
template <bool kRemembered>
struct Search {
  const FacePackets& color;
  const Vectors& p;
  PacketLook* looks;
  Nearest nearest = {};
  float squared = kInfinity;  ///< of the nearest face
  int packet = 0;             ///< of the nearest face

  /// Looks at all faces of a packet, which are then known better than by its box. No branch: which packet is
  /// nearest cannot be foretold.
  HWY_INLINE void visit(int i) {
    PacketLook& look = looks[i / FacePackets::kBoxes];
    const int place = i % FacePackets::kBoxes;
    const float found = consider<kRemembered>(p, color.packets[i], color.slack, nearest, look.planes[place]);
    packet = found < squared ? i : packet;
    squared = found < squared ? found : squared;
    look.bounds[place] = kInfinity;
    look.visited |= 1u << place;
  }
  /// No face of a packet whose bound is above this is as near.
  HWY_INLINE float limit() const { return std::sqrt(squared) * (1 + kShare) + color.slack; }

  /// Looks at the packets whose boxes are that near, and have not been looked at.
  HWY_INLINE void visit_near(float limit) {
    const int count = static_cast<int>(color.packets.size());
    for (int first = 0; first < count; first += kMany) {
      for (uint64_t bits = near_packets(first, limit); bits != 0; bits &= bits - 1)
        visit(first + std::countr_zero(bits));
    }
  }

  /// Lists the faces that may be nearest when the point comes again, having moved a little.
  HWY_INLINE void remember(float near, PointMemory& memory) const {
    FaceList list(near);
    list.add(color, packet, looks);
    auto others = hn::Set(kBoxFloats, kInfinity);
    const int count = static_cast<int>(color.packets.size());
    for (int group = 0; group * FacePackets::kBoxes < count; ++group) {
      const PacketLook& look = looks[group];
      for (size_t i = 0; i < FacePackets::kBoxes; i += hn::Lanes(kBoxFloats))
        others = hn::Min(others, hn::Load(kBoxFloats, look.bounds + i));
    }
    for (int first = 0; first < count; first += kMany) {
      for (uint64_t bits = visited(first); bits != 0; bits &= bits - 1) {
        const int i = first + std::countr_zero(bits);
        if (i != packet) list.add(color, i, looks);
      }
    }
    memory.reach = near;
    memory.others_beyond = std::min(list.copy_to(memory), hn::GetLane(hn::MinOfLanes(kBoxFloats, others)));
  }

 private:
  /// Packets that a number has a bit for: in one loop over them less is foretold wrongly than in several.
  static constexpr int kMany = 64;

  HWY_INLINE uint64_t near_packets(int first, float limit) const {
    const int count = std::min(kMany, static_cast<int>(color.packets.size()) - first);
    uint64_t bits = 0;
    for (int i = 0; i < count; i += hn::MaxLanes(kBoxFloats)) {
      const PacketLook& look = looks[(first + i) / FacePackets::kBoxes];
      bits |= uint64_t{not_above(look.bounds + i % FacePackets::kBoxes, limit)} << i;
    }
    return bits & ~visited(first) & (~uint64_t{0} >> (kMany - count));
  }
  HWY_INLINE uint64_t visited(int first) const {
    const int count = std::min(kMany, static_cast<int>(color.packets.size()) - first);
    uint64_t bits = 0;
    for (int i = 0; i < count; i += FacePackets::kBoxes)
      bits |= uint64_t{looks[(first + i) / FacePackets::kBoxes].visited} << i;
    return bits;
  }
};

/// Where in the packets a face is: as a rule in this one. Of equally near faces the first may be in another.
HWY_INLINE int place_of(int face, const FacePackets& color, int packet) {
  const auto place_in = [&](int i) {
    const int32_t* const faces = color.packets[i].face;
    const auto lane = static_cast<int>(std::find(faces, faces + FacePackets::kFaces, face) - faces);
    return lane < FacePackets::kFaces ? i * FacePackets::kFaces + lane : -1;
  };
  int place = place_in(packet);
  for (int i = 0; place < 0 && i < static_cast<int>(color.packets.size()); ++i) place = place_in(i);
  return place;  // -1: no face was found
}

template <bool kRemembered>
HWY_INLINE ClosestPoint search_all(const Eigen::Vector3f& p_hand, const FacePackets& color, int start,
                                   PacketLook* looks, PointMemory& memory) {
  const Vectors p = {hn::Set(kFloats, p_hand.x()), hn::Set(kFloats, p_hand.y()), hn::Set(kFloats, p_hand.z())};
  Search<kRemembered> search{color, p, looks};
  bound_packets(p_hand, color, looks);
  search.visit(start);
  // A point that stays is near the packet where it was: what is near it, too, will be wanted.
  search.visit_near(search.limit() + (kRemembered ? PointMemory::kNear : 0));
  memory.p_hand = p_hand;
  memory.others_beyond = -kInfinity;
  if constexpr (kRemembered) search.remember(search.limit() + PointMemory::kNear, memory);
  const ClosestPoint closest = best_of_lanes(search.nearest, search.squared);
  memory.nearest = place_of(closest.face, color, search.packet);
  return closest;
}

/// Nothing is listed for a point that comes for the first time, or from so far away that it will not stay.
HWY_INLINE ClosestPoint search(const Eigen::Vector3f& p_hand, const FacePackets& color, int start,
                               PacketLook* looks, PointMemory& memory) {
  const bool stays = memory.nearest >= 0 && (p_hand - memory.p_hand).norm() < PointMemory::kStays;
  return stays ? search_all<true>(p_hand, color, start, looks, memory)
               : search_all<false>(p_hand, color, start, looks, memory);
}

/// Pairs of a point and a face that may be its nearest, those of a point together: to be measured side by side.
class Contenders {
 public:
  Contenders(std::span<PointMemory> memories, ClosestPoint* results) : memories_(memories), results_(results) {}

  /// Room for all that one point may bring.
  HWY_INLINE void make_room() {
    if (count_ + PointMemory::kFaces > kCapacity) measure();
  }
  HWY_INLINE void add(int point, const Eigen::Vector3f& p, const FacePackets& color, int place) {
    const FacePackets::Packet& packet = color.packets[place / FacePackets::kFaces];
    const int face = place % FacePackets::kFaces;
    for (int axis = 0; axis < 3; ++axis) {
      p_[axis][count_] = p[axis];
      a_[axis][count_] = packet.a[axis][face];
      b_[axis][count_] = packet.b[axis][face];
      c_[axis][count_] = packet.c[axis][face];
    }
    point_[count_] = point;
    face_[count_] = packet.face[face];
    place_[count_++] = place;
  }
  /// Gives each point that is here its nearest face.
  HWY_INLINE void measure() {
    for (int i = 0; i < count_; i += hn::MaxLanes(kFloats)) {
      const Vectors p = load(p_, i);
      const Vectors closest = closest_on_faces(p, load(a_, i), load(b_, i), load(c_, i)), apart = closest - p;
      store(closest, p_, i);
      hn::Store(dot(apart, apart), kFloats, squared_ + i);
    }
    for (int i = 0; i < count_;) {
      const int point = point_[i];
      // The order of distances, and of faces where they are equal, is that of these numbers. What is not a number
      // comes after all that are. No branch: which is nearest cannot be foretold.
      uint64_t least = kNone;
      int best = i;
      for (; i < count_ && point_[i] == point; ++i) {
        const uint64_t key = uint64_t{std::bit_cast<uint32_t>(squared_[i])} << 32 | static_cast<uint32_t>(face_[i]);
        best = key < least ? i : best;
        least = key < least ? key : least;
      }
      if (least >= kNone) {
        results_[point] = {};
        continue;
      }
      results_[point] = {Eigen::Vector3f(p_[0][best], p_[1][best], p_[2][best]), std::sqrt(squared_[best]),
                         face_[best]};
      memories_[point].nearest = place_[best];
    }
    count_ = 0;
  }

 private:
  static constexpr int kCapacity = 128;
  static constexpr uint64_t kNone = uint64_t{std::bit_cast<uint32_t>(kInfinity)} << 32;

  std::span<PointMemory> memories_;
  ClosestPoint* results_;
  int count_ = 0;
  alignas(64) float p_[3][kCapacity] = {}, a_[3][kCapacity] = {}, b_[3][kCapacity] = {}, c_[3][kCapacity] = {};
  alignas(64) float squared_[kCapacity] = {};
  int point_[kCapacity], face_[kCapacity], place_[kCapacity];
};

/// The listed faces, a bit each, whose planes are not farther than the limit.
HWY_INLINE uint32_t not_behind(const PointMemory& memory, const Eigen::Vector3f& p, float limit) {
  const auto x = hn::Set(kListFloats, p.x()), y = hn::Set(kListFloats, p.y()), z = hn::Set(kListFloats, p.z());
  uint32_t faces = 0;
  for (size_t first = 0; first < PointMemory::kFaces; first += hn::Lanes(kListFloats)) {
    const auto along = hn::MulAdd(hn::Load(kListFloats, memory.normal[0] + first), x,
                                  hn::MulAdd(hn::Load(kListFloats, memory.normal[1] + first), y,
                                             hn::MulSub(hn::Load(kListFloats, memory.normal[2] + first), z,
                                                        hn::Load(kListFloats, memory.offset + first))));
    uint8_t bits[8] = {};  // StoreMaskBits may write eight bytes
    hn::StoreMaskBits(kListFloats, hn::Not(hn::Gt(along, hn::Set(kListFloats, limit))), bits);
    faces |= (bits[0] | uint32_t{bits[1]} << 8) << first;
  }
  return faces;
}

/// The listed faces of a point, a bit each, that may be its nearest; 0 if a face that is not listed may be it. No
/// branch: what follows from one point would wait for its square roots.
HWY_INLINE uint32_t nearest_among_listed(const Eigen::Vector3f& p_hand, const FacePackets& color,
                                         const PointMemory& memory, const ClosestPoint& last) {
  // Where the closest point was there still is the face: that was in doubt then, and may be now.
  const int place = std::max(0, memory.nearest), face = place % FacePackets::kFaces;
  const FacePackets::Packet& packet = color.packets[place / FacePackets::kFaces];
  const float apart = (p_hand - last.p_hand).norm(), farther = std::max(apart, last.distance);
  const float limit =
      apart * (1 + kShare) + 2 * doubt(farther, packet.length[face], packet.blur[face], color.slack);
  const float moved = (p_hand - memory.p_hand).norm() * (1 + kShare);
  const int all = (memory.nearest >= 0) & (limit < memory.others_beyond - moved) & (limit <= memory.reach);
  return all * not_behind(memory, p_hand, limit);
}

void FindClosest(const FacePackets* colors, std::span<const LabeledPoint> points, std::span<PointMemory> memories,
                 PacketLook* looks, ClosestPoint* results) {
  int last_packets[kColorCount + 1] = {};  // the point before is a neighbor
  Contenders contenders(memories, results);
  constexpr size_t kBlock = 64;
  uint32_t listed[kBlock];
  for (size_t begin = 0; begin < points.size(); begin += kBlock) {
    const size_t count = std::min(kBlock, points.size() - begin);
    for (size_t i = 0; i < count; ++i) {
      const LabeledPoint& point = points[begin + i];
      const FacePackets& color = colors[point.label];
      if (color.packets.empty()) continue;
      PointMemory& memory = memories[begin + i];
      if (memory.label != point.label) memory = {.label = point.label};
      listed[i] = nearest_among_listed(point.p, color, memory, results[begin + i]);
    }
    for (size_t i = 0; i < count; ++i) {
      const LabeledPoint& point = points[begin + i];
      const FacePackets& color = colors[point.label];
      PointMemory& memory = memories[begin + i];
      if (color.packets.empty()) {
        results[begin + i] = {};
      } else if (listed[i] != 0) {
        contenders.make_room();
        for (uint32_t bits = listed[i]; bits != 0; bits &= bits - 1)
          contenders.add(static_cast<int>(begin + i), point.p, color, memory.place[std::countr_zero(bits)]);
      } else {
        const int start = memory.nearest >= 0 ? memory.nearest / FacePackets::kFaces : last_packets[point.label];
        results[begin + i] = search(point.p, color, start, looks, memory);
        last_packets[point.label] = std::max(0, memory.nearest) / FacePackets::kFaces;
      }
    }
  }
  contenders.measure();
}

}  // namespace glovebench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glovebench {
namespace {
HWY_EXPORT(FindClosest);
}  // namespace

void ClosestPointSearch::start(const Surface& surface) {
  size_t boxes = 0;
  for (uint8_t label = 0; label < colors_.size(); ++label) {
    colors_[label].assign(surface.faces(label));
    boxes = std::max(boxes, colors_[label].boxes.size());
  }
  looks_.resize(boxes);
  memory_.clear();
}

const RecycledVector<ClosestPoint>& ClosestPointSearch::operator()(std::span<const LabeledPoint> points_hand) {
  memory_.resize(points_hand.size());
  closest_.resize(points_hand.size());
  HWY_DYNAMIC_DISPATCH(FindClosest)
  (colors_.data(), points_hand, memory_, looks_.data(), closest_.data());
  return closest_;
}

}  // namespace glovebench
#endif
