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
using Floats = hn::VFromD<decltype(kFloats)>;
using Ints = hn::VFromD<decltype(kInts)>;
using Mask = decltype(hn::MaskFromVec(Floats()));

constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// What the roundings of a distance and of a bound may be, as a share of them: several times 2^-24.
constexpr float kShare = 1e-6f;
/// Makes a difference of two numbers no larger than the exact one: two roundings less.
constexpr float kRoundedDown = 1 - 0x1p-22f;

struct Vectors {
  Floats x, y, z;
};

HWY_INLINE Vectors load(const float (&values)[3][FacePackets::kFaces], size_t first) {
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
HWY_INLINE Mask all(Mask a, Mask b, Mask c) {
  return hn::And(a, hn::And(b, c));
}

/// `closest_on_triangle` for some faces of a packet, with exactly its operations in each lane.
HWY_INLINE Vectors closest_on_faces(const Vectors& p, const FacePackets::Packet& packet, size_t first) {
  const Vectors a = load(packet.a, first), b = load(packet.b, first), c = load(packet.c, first);
  const Vectors ab = load(packet.ab, first), ac = load(packet.ac, first);
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

/// The nearest faces so far, a lane each.
struct Nearest {
  Floats squared = hn::Set(kFloats, kInfinity);
  Ints face = hn::Set(kInts, -1);
  Vectors p = {hn::Zero(kFloats), hn::Zero(kFloats), hn::Zero(kFloats)};
};

/// Takes the faces of a packet where they are nearer, or as near and come first. Returns the square of the least
/// distance in the packet.
HWY_INLINE float consider(const Vectors& p, const FacePackets::Packet& packet, Nearest& nearest) {
  Floats least = hn::Set(kFloats, kInfinity);
  for (size_t first = 0; first < FacePackets::kFaces; first += hn::Lanes(kFloats)) {
    const Vectors closest = closest_on_faces(p, packet, first);
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
  }
  return hn::GetLane(hn::MinOfLanes(kFloats, least));
}

/// The nearest of all lanes; of equally near ones the first face.
HWY_INLINE ClosestPoint best_of_lanes(const Nearest& nearest, float squared) {
  if (!(squared < kInfinity)) return {};
  constexpr size_t kLanes = hn::MaxLanes(kFloats);
  alignas(64) float distance[kLanes], x[kLanes], y[kLanes], z[kLanes];
  alignas(64) int32_t face[kLanes];
  hn::Store(nearest.squared, kFloats, distance);
  hn::Store(nearest.face, kInts, face);
  hn::Store(nearest.p.x, kFloats, x);
  hn::Store(nearest.p.y, kFloats, y);
  hn::Store(nearest.p.z, kFloats, z);
  size_t best = static_cast<size_t>(hn::FindFirstTrue(kFloats, hn::Eq(nearest.squared, hn::Set(kFloats, squared))));
  for (size_t i = best + 1; i < kLanes; ++i)
    if (distance[i] == squared && face[i] < face[best]) best = i;
  return {Eigen::Vector3f(x[best], y[best], z[best]), std::sqrt(squared), face[best]};
}

/// What rounding leaves in doubt of the distance of a packet's faces.
HWY_INLINE float doubt(const FacePackets& color, int packet, float distance) {
  const FacePackets::Boxes& boxes = color.boxes[packet / FacePackets::kBoxes];
  const int i = packet % FacePackets::kBoxes;
  const float reach = distance + boxes.diagonal[i];
  return color.slack + kShare * distance + boxes.blur[i] * (reach * reach);
}

template <typename V>
HWY_INLINE V outside(V at, const float* low, const float* high) {
  const V below = hn::Sub(hn::Load(kBoxFloats, low), at), above = hn::Sub(at, hn::Load(kBoxFloats, high));
  return hn::Max(hn::Zero(kBoxFloats), hn::Max(below, above));
}

/// For each packet how near its faces can be to the point: its box's distance less the same doubt.
HWY_INLINE void bound_packets(const Eigen::Vector3f& p, const FacePackets& color, float* bounds) {
  const auto x = hn::Set(kBoxFloats, p.x()), y = hn::Set(kBoxFloats, p.y()), z = hn::Set(kBoxFloats, p.z());
  const auto share = hn::Set(kBoxFloats, kShare), slack = hn::Set(kBoxFloats, color.slack);
  for (const FacePackets::Boxes& boxes : color.boxes) {
    for (size_t i = 0; i < FacePackets::kBoxes; i += hn::Lanes(kBoxFloats)) {
      const auto dx = outside(x, boxes.low[0] + i, boxes.high[0] + i);
      const auto dy = outside(y, boxes.low[1] + i, boxes.high[1] + i);
      const auto dz = outside(z, boxes.low[2] + i, boxes.high[2] + i);
      const auto distance = hn::Sqrt(hn::Add(hn::Mul(dx, dx), hn::Add(hn::Mul(dy, dy), hn::Mul(dz, dz))));
      const auto reach = hn::Add(distance, hn::Load(kBoxFloats, boxes.diagonal + i));
      const auto blur = hn::Mul(hn::Load(kBoxFloats, boxes.blur + i), hn::Mul(reach, reach));
      const auto in_doubt = hn::Add(hn::Add(slack, hn::Mul(share, distance)), blur);
      hn::Store(hn::Sub(distance, in_doubt), kBoxFloats, bounds + i);
    }
    bounds += FacePackets::kBoxes;
  }
}

/// The search of one point over the packets of its color.
struct Search {
  const FacePackets& color;
  const Vectors& p;
  Nearest nearest = {};
  float squared = kInfinity;  ///< of the nearest face
  int packet = 0;             ///< of the nearest face

  /// Looks at all faces of a packet. Returns what its faces are at least away from the point. No branch: which
  /// packet is nearest cannot be foretold.
  HWY_INLINE float visit(int i) {
    const float found = consider(p, color.packets[i], nearest);
    packet = found < squared ? i : packet;
    squared = found < squared ? found : squared;
    const float distance = std::sqrt(found);
    return distance - doubt(color, i, distance);
  }
  /// No face of a packet whose bound is above this is as near.
  HWY_INLINE float limit() const { return std::sqrt(squared) * (1 + kShare) + color.slack; }
};

/// The packets of some boxes, a bit each, whose bounds are not above the limit.
HWY_INLINE uint32_t not_above(const float* bounds, float limit) {
  const auto above = hn::Gt(hn::Load(kBoxFloats, bounds), hn::Set(kBoxFloats, limit));
  uint8_t bits[8] = {};  // StoreMaskBits may write eight bytes
  hn::StoreMaskBits(kBoxFloats, hn::Not(above), bits);
  return bits[0] | uint32_t{bits[1]} << 8;
}

/// Looks at the packets whose boxes are near enough; one has been looked at. These are then known better than by
/// their boxes.
HWY_INLINE void visit_near_packets(Search& search, float* bounds, int done) {
  const float limit = search.limit();
  const int count = static_cast<int>(search.color.packets.size()), lanes = hn::MaxLanes(kBoxFloats);
  for (int first = 0; first < count; first += lanes) {
    for (uint32_t bits = not_above(bounds + first, limit); bits != 0; bits &= bits - 1) {
      const int i = first + std::countr_zero(bits);
      if (i != done && i < count) bounds[i] = search.visit(i);
    }
  }
}

/// Lists the packets that may be nearest when the point comes again, having moved a little.
HWY_INLINE void remember(const Search& search, float* bounds, const Eigen::Vector3f& p, PacketMemory& memory) {
  memory = {.p_hand = p,
            .others_beyond = kInfinity,
            .count = 1,
            .packets = {search.packet},
            .bounds = {bounds[search.packet]}};
  bounds[search.packet] = kInfinity;
  const float near = search.limit() + PacketMemory::kNear;
  const auto infinity = hn::Set(kBoxFloats, kInfinity);
  auto others = infinity;
  const int count = static_cast<int>(search.color.packets.size()), lanes = hn::MaxLanes(kBoxFloats);
  for (int first = 0; first < count; first += lanes) {
    const auto some = hn::Load(kBoxFloats, bounds + first);
    others = hn::Min(others, hn::IfThenElse(hn::Gt(some, hn::Set(kBoxFloats, near)), some, infinity));
    for (uint32_t bits = not_above(bounds + first, near); bits != 0; bits &= bits - 1) {
      const int i = first + std::countr_zero(bits);
      if (i >= count) break;
      // What is not a number bounds nothing.
      const float bound = bounds[i] >= -kInfinity ? bounds[i] : -kInfinity;
      if (memory.count < PacketMemory::kPackets) {
        memory.packets[memory.count] = i;
        memory.bounds[memory.count++] = bound;
      } else {
        memory.others_beyond = std::min(memory.others_beyond, bound);
      }
    }
  }
  memory.others_beyond = std::min(memory.others_beyond, hn::GetLane(hn::MinOfLanes(kBoxFloats, others)));
}

/// Looks at the listed packets alone if none of the others can be nearest. False if one can.
HWY_INLINE bool visit_listed(Search& search, float first_bound, const Eigen::Vector3f& p, PacketMemory& memory) {
  const float moved = (p - memory.p_hand).norm() * (1 + kShare), limit = search.limit();
  if (!(limit < memory.others_beyond - moved)) return false;
  memory.p_hand = p;
  memory.others_beyond = (memory.others_beyond - moved) * kRoundedDown;
  memory.bounds[0] = first_bound;
  int best = 0;
  for (int i = 1; i < memory.count; ++i) {
    memory.bounds[i] = (memory.bounds[i] - moved) * kRoundedDown;
    if (memory.bounds[i] > limit) continue;
    const float before = search.squared;
    memory.bounds[i] = search.visit(memory.packets[i]);
    best = search.squared < before ? i : best;
  }
  std::swap(memory.packets[0], memory.packets[best]);
  std::swap(memory.bounds[0], memory.bounds[best]);
  return true;
}

HWY_INLINE ClosestPoint find(const LabeledPoint& point, const FacePackets& color, float* bounds,
                             PacketMemory& memory, int& last_packet) {
  const Vectors p = {hn::Set(kFloats, point.p.x()), hn::Set(kFloats, point.p.y()), hn::Set(kFloats, point.p.z())};
  Search search{color, p};
  const int start = memory.count > 0 ? memory.packets[0] : last_packet;
  const float first_bound = search.visit(start);
  if (memory.count == 0 || !visit_listed(search, first_bound, point.p, memory)) {
    bound_packets(point.p, color, bounds);
    bounds[start] = first_bound;
    visit_near_packets(search, bounds, start);
    remember(search, bounds, point.p, memory);
    last_packet = search.packet;
  }
  return best_of_lanes(search.nearest, search.squared);
}

void FindClosest(const FacePackets* colors, std::span<const LabeledPoint> points, PacketMemory* memories,
                 float* bounds, ClosestPoint* results) {
  int last_packets[kColorCount + 1] = {};  // the point before is a neighbor
  for (size_t i = 0; i < points.size(); ++i) {
    const uint8_t label = points[i].label;
    const FacePackets& color = colors[label];
    results[i] =
        color.packets.empty() ? ClosestPoint{} : find(points[i], color, bounds, memories[i], last_packets[label]);
  }
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
  bounds_.resize(std::max<size_t>(1, boxes));
  memory_.clear();
}

const std::vector<ClosestPoint>& ClosestPointSearch::operator()(std::span<const LabeledPoint> points_hand) {
  memory_.resize(points_hand.size());
  closest_.resize(points_hand.size());
  HWY_DYNAMIC_DISPATCH(FindClosest)
  (colors_.data(), points_hand, memory_.data(), bounds_.data()->bounds, closest_.data());
  return closest_;
}

}  // namespace glovebench
#endif
