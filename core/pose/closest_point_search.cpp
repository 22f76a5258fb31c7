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

HWY_BEFORE_NAMESPACE();
namespace glovebench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<float, FacePackets::kFaces> kFloats;
constexpr hn::RebindToSigned<decltype(kFloats)> kInts;
constexpr hn::CappedTag<float, FacePackets::kBoxes> kBoxFloats;
constexpr hn::CappedTag<float, PointMemory::kFaces> kListFloats;
constexpr hn::RebindToSigned<decltype(kListFloats)> kListInts;
using Floats = hn::VFromD<decltype(kFloats)>;
using Ints = hn::VFromD<decltype(kInts)>;
using Mask = decltype(hn::MaskFromVec(Floats()));

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// What the roundings of a distance and of a bound may be, as a share of them: several times 2^-24.
constexpr float kShare = 1e-6f;

struct Vectors {
  Floats x, y, z;
};

template <size_t kCount>
HWY_INLINE Vectors load(const float (&values)[3][kCount], size_t first) {
  return {hn::Load(kFloats, values[0] + first), hn::Load(kFloats, values[1] + first),
          hn::Load(kFloats, values[2] + first)};
}
HWY_INLINE Vectors operator-(const Vectors& a, const Vectors& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vectors operator+(const Vectors& a, const Vectors& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Vectors operator*(Floats s, const Vectors& v) {
  return {hn::Mul(s, v.x), hn::Mul(s, v.y), hn::Mul(s, v.z)};
}
/// In the order in which Eigen adds.
HWY_INLINE Floats dot(const Vectors& a, const Vectors& b) {
  return hn::Add(hn::Mul(a.x, b.x), hn::Add(hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)));
}
HWY_INLINE Floats cross(Floats a, Floats b, Floats c, Floats d) {
  return hn::Sub(hn::Mul(a, b), hn::Mul(c, d));
}
HWY_INLINE Vectors choose(Mask mask, const Vectors& yes, const Vectors& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}
template <size_t kCount>
HWY_INLINE void store(const Vectors& v, float (&values)[3][kCount], size_t first) {
  hn::Store(v.x, kFloats, values[0] + first);
  hn::Store(v.y, kFloats, values[1] + first);
  hn::Store(v.z, kFloats, values[2] + first);
}
HWY_INLINE Mask all(Mask a, Mask b, Mask c) {
  return hn::And(a, hn::And(b, c));
}

/// `closest_on_triangle` with exactly its operations in each lane: a difference rounded otherwise would be another
/// face's victory.
HWY_INLINE Vectors closest_on_faces(const Vectors& p, const Vectors& a, const Vectors& b, const Vectors& c) {
  const Vectors ab = b - a, ac = c - a;
  const Vectors ap = p - a, bp = p - b, cp = p - c;
  const Floats d1 = dot(ab, ap), d2 = dot(ac, ap);
  const Floats d3 = dot(ab, bp), d4 = dot(ac, bp);
  const Floats d5 = dot(ab, cp), d6 = dot(ac, cp);
  const Floats vc = cross(d1, d4, d3, d2), vb = cross(d5, d2, d1, d6), va = cross(d3, d6, d5, d4);
  const Floats zero = hn::Zero(kFloats), d43 = hn::Sub(d4, d3), d56 = hn::Sub(d5, d6);

  // The regions in the order in which they are asked for; a later one counts where no earlier one does.
  const Mask at_a = hn::And(hn::Le(d1, zero), hn::Le(d2, zero));
  const Mask at_b = hn::And(hn::Ge(d3, zero), hn::Le(d4, d3));
  const Mask on_ab = all(hn::Le(vc, zero), hn::Ge(d1, zero), hn::Le(d3, zero));
  const Mask at_c = hn::And(hn::Ge(d6, zero), hn::Le(d5, d6));
  const Mask on_ac = all(hn::Le(vb, zero), hn::Ge(d2, zero), hn::Le(d6, zero));
  const Mask on_bc = all(hn::Le(va, zero), hn::Ge(d43, zero), hn::Ge(d56, zero));

  Floats numerator = hn::Set(kFloats, 1.0f), denominator = hn::Add(hn::Add(va, vb), vc);
  numerator = hn::IfThenElse(on_bc, d43, numerator);
  denominator = hn::IfThenElse(on_bc, hn::Add(d43, d56), denominator);
  numerator = hn::IfThenElse(on_ac, d2, numerator);
  denominator = hn::IfThenElse(on_ac, hn::Sub(d2, d6), denominator);
  numerator = hn::IfThenElse(on_ab, d1, numerator);
  denominator = hn::IfThenElse(on_ab, hn::Sub(d1, d3), denominator);
  const Floats share = hn::Div(numerator, denominator);

  const Vectors inside = (a + hn::Mul(vb, share) * ab) + hn::Mul(vc, share) * ac;
  const Mask on_a_edge = hn::Or(on_ab, on_ac);
  const Vectors foot = choose(on_a_edge, a, b), edge = choose(on_ab, ab, choose(on_ac, ac, c - b));
  Vectors result = choose(hn::Or(on_a_edge, on_bc), foot + share * edge, inside);
  result = choose(hn::AndNot(on_ab, at_c), c, result);
  result = choose(at_b, b, result);
  return choose(at_a, a, result);
}

/// What rounding leaves in doubt of a face's distance, seen from so far away.
template <typename V>
HWY_INLINE V doubt(V distance, V length, V blur, V slack, V share) {
  const V reach = hn::Add(distance, length);
  return hn::Add(hn::Add(slack, hn::Mul(share, distance)), hn::Mul(blur, hn::Mul(reach, reach)));
}
HWY_INLINE float doubt(float distance, float length, float blur, float slack) {
  const float reach = distance + length;
  return slack + kShare * distance + blur * (reach * reach);
}
HWY_INLINE Floats doubt(Floats distance, const FacePackets::Packet& packet, size_t first, float slack) {
  return doubt(distance, hn::Load(kFloats, packet.length + first), hn::Load(kFloats, packet.blur + first),
               hn::Set(kFloats, slack), hn::Set(kFloats, kShare));
}

/// The planes through the closest points, across the way to them: a face, being convex, lies behind its plane. If
/// rounding has put a closest point beside its place, the plane is tilted; what a face may then stick out is taken
/// off.
HWY_INLINE void set_planes(const Vectors& closest, const Vectors& apart, Floats squared,
                           const FacePackets::Packet& packet, size_t first, float slack, FacePlanes& planes) {
  const Floats distance = hn::Sqrt(squared), inverse = hn::Div(hn::Set(kFloats, -1.0f), distance);
  const Vectors normal = inverse * apart;
  const Floats tilt = hn::NegMulAdd(inverse, hn::Load(kFloats, packet.length + first), hn::Set(kFloats, 2.0f));
  const Floats sticks_out = hn::Mul(doubt(distance, packet, first, slack), tilt);
  store(normal, planes.normal, first);
  hn::Store(hn::Add(dot(normal, closest), sticks_out), kFloats, planes.offset + first);
  hn::Store(hn::Sub(distance, sticks_out), kFloats, planes.distance + first);
}

/// The nearest faces so far, a lane each.
struct Nearest {
  Floats squared = hn::Set(kFloats, kInfinity);
  Ints face = hn::Set(kInts, -1);
  Vectors p = {hn::Zero(kFloats), hn::Zero(kFloats), hn::Zero(kFloats)};
};

/// Takes the faces of a packet where they are nearer, or as near and come first, and notes their planes if asked
/// to. Returns the square of the least distance in the packet.
template <bool kWithPlanes>
HWY_INLINE float consider(const Vectors& p, const FacePackets::Packet& packet, float slack, Nearest& nearest,
                          FacePlanes& planes) {
  Floats least = hn::Set(kFloats, kInfinity);
  for (size_t first = 0; first < FacePackets::kFaces; first += hn::Lanes(kFloats)) {
    const Vectors closest =
        closest_on_faces(p, load(packet.a, first), load(packet.b, first), load(packet.c, first));
    const Vectors apart = closest - p;
    const Floats squared = dot(apart, apart);
    const Ints face = hn::Load(kInts, packet.face + first);
    const Mask comes_first =
        hn::And(hn::Eq(squared, nearest.squared), hn::RebindMask(kFloats, hn::Lt(face, nearest.face)));
    const Mask better = hn::Or(hn::Lt(squared, nearest.squared), comes_first);
    nearest.squared = hn::IfThenElse(better, squared, nearest.squared);
    nearest.face = hn::IfThenElse(hn::RebindMask(kInts, better), face, nearest.face);
    nearest.p = choose(better, closest, nearest.p);
    least = hn::IfThenElse(hn::Lt(squared, least), squared, least);  // never one that is not a number
    if constexpr (kWithPlanes) set_planes(closest, apart, squared, packet, first, slack, planes);
  }
  return hn::GetLane(hn::MinOfLanes(kFloats, least));
}

/// The nearest of all lanes; of equally near ones the first face.
HWY_INLINE ClosestPoint best_of_lanes(const Nearest& nearest, float squared) {
  if (!(squared < kInfinity)) return {};
  const auto is_near = hn::RebindMask(kInts, hn::Eq(nearest.squared, hn::Set(kFloats, squared)));
  const Ints none = hn::Set(kInts, std::numeric_limits<int32_t>::max());
  const Ints faces = hn::IfThenElse(is_near, nearest.face, none);
  const Ints first = hn::MinOfLanes(kInts, faces);
  const auto lane = static_cast<size_t>(hn::FindFirstTrue(kInts, hn::Eq(faces, first)));
  alignas(64) float p[3][hn::MaxLanes(kFloats)];
  store(nearest.p, p, 0);
  return {Eigen::Vector3f(p[0][lane], p[1][lane], p[2][lane]), std::sqrt(squared), hn::GetLane(first)};
}

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

const std::vector<ClosestPoint>& ClosestPointSearch::operator()(std::span<const LabeledPoint> points_hand) {
  memory_.resize(points_hand.size());
  closest_.resize(points_hand.size());
  HWY_DYNAMIC_DISPATCH(FindClosest)
  (colors_.data(), points_hand, memory_, looks_.data(), closest_.data());
  return closest_;
}

}  // namespace glovebench
#endif
