// Included for each instruction set (Highway), so the include guard toggles.
#if defined(GLOVEBENCH_CORE_POSE_CLOSEST_ON_FACES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GLOVEBENCH_CORE_POSE_CLOSEST_ON_FACES_INL_H
#undef GLOVEBENCH_CORE_POSE_CLOSEST_ON_FACES_INL_H
#else
#define GLOVEBENCH_CORE_POSE_CLOSEST_ON_FACES_INL_H
#endif

#include <hwy/highway.h>

#include <limits>

#include "core/pose/closest_point_search.h"
#include "core/pose/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glovebench::HWY_NAMESPACE {

constexpr hn::CappedTag<float, PointGroup::kPoints> kFloats;
constexpr hn::RebindToSigned<decltype(kFloats)> kInts;
using Floats = hn::VFromD<decltype(kFloats)>;
using FloatVectors = Vectors<Floats>;
using Ints = hn::VFromD<decltype(kInts)>;
using Mask = decltype(hn::MaskFromVec(Floats()));

constexpr float kInfinity = std::numeric_limits<float>::infinity();

HWY_INLINE FloatVectors set(const float (&v)[3]) {
  return {hn::Set(kFloats, v[0]), hn::Set(kFloats, v[1]), hn::Set(kFloats, v[2])};
}
HWY_INLINE Mask all(Mask a, Mask b, Mask c) { return hn::And(a, hn::And(b, c)); }

/// Repeats `closest_on_triangle` exactly: other rounding could select another face.
HWY_INLINE FloatVectors closest_on_face(const FloatVectors& p, const FacePackets::Face& face) {
  const FloatVectors a = set(face.a), b = set(face.b), c = set(face.c), ab = set(face.ab), ac = set(face.ac);
  const FloatVectors ap = p - a, bp = p - b, cp = p - c;
  const Floats d1 = dot(ab, ap), d2 = dot(ac, ap);
  const Floats d3 = dot(ab, bp), d4 = dot(ac, bp);
  const Floats d5 = dot(ab, cp), d6 = dot(ac, cp);
  const Floats vc = cross(d1, d4, d3, d2), vb = cross(d5, d2, d1, d6), va = cross(d3, d6, d5, d4);
  const Floats zero = hn::Zero(kFloats), d43 = hn::Sub(d4, d3), d56 = hn::Sub(d5, d6);

  // Earlier tests win.
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

  const FloatVectors inside = (a + hn::Mul(vb, share) * ab) + hn::Mul(vc, share) * ac;
  const Mask on_a_edge = hn::Or(on_ab, on_ac);
  const FloatVectors foot = choose(on_a_edge, a, b), edge = choose(on_ab, ab, choose(on_ac, ac, c - b));
  FloatVectors result = choose(hn::Or(on_a_edge, on_bc), foot + share * edge, inside);
  result = choose(hn::AndNot(on_ab, at_c), c, result);
  result = choose(at_b, b, result);
  return choose(at_a, a, result);
}

struct Nearest {
  Floats squared;
  Ints face;
  FloatVectors p;

  HWY_INLINE Nearest()
      : squared(hn::Set(kFloats, kInfinity)),
        face(hn::Set(kInts, -1)),
        p{hn::Zero(kFloats), hn::Zero(kFloats), hn::Zero(kFloats)} {}
  /// Takes a nearer face; of equally near ones, the smaller index. Ignores NaN.
  HWY_INLINE void consider(const FloatVectors& points, const FacePackets::Face& candidate) {
    const FloatVectors closest = closest_on_face(points, candidate), apart = closest - points;
    const Floats distance2 = dot(apart, apart);
    const Ints index = hn::Set(kInts, candidate.face);
    const Mask comes_first = hn::And(hn::Eq(distance2, squared), hn::RebindMask(kFloats, hn::Lt(index, face)));
    const Mask better = hn::Or(hn::Lt(distance2, squared), comes_first);
    squared = hn::IfThenElse(better, distance2, squared);
    face = hn::IfThenElse(hn::RebindMask(kInts, better), index, face);
    p = choose(better, closest, p);
  }
};

}  // namespace glovebench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
