// The closest points of several faces to one point, side by side.
// Included once for each instruction set (Highway); the guard turns with it.
#if defined(GLOVEBENCH_CORE_POSE_CLOSEST_ON_FACES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GLOVEBENCH_CORE_POSE_CLOSEST_ON_FACES_INL_H
#undef GLOVEBENCH_CORE_POSE_CLOSEST_ON_FACES_INL_H
#else
#define GLOVEBENCH_CORE_POSE_CLOSEST_ON_FACES_INL_H
#endif

#include <hwy/highway.h>

#include <cmath>
#include <limits>

#include "core/pose/closest_point_search.h"

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

}  // namespace glovebench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
