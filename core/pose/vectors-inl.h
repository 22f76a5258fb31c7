// Included for each instruction set (Highway), so the include guard toggles.
#if defined(GLOVEBENCH_CORE_POSE_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GLOVEBENCH_CORE_POSE_VECTORS_INL_H
#undef GLOVEBENCH_CORE_POSE_VECTORS_INL_H
#else
#define GLOVEBENCH_CORE_POSE_VECTORS_INL_H
#endif

#include <hwy/highway.h>

#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace glovebench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A three-dimensional vector in each lane.
template <typename V>
struct Vectors {
  V x, y, z;
};

template <typename V>
HWY_INLINE Vectors<V> operator-(const Vectors<V>& a, const Vectors<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <typename V>
HWY_INLINE Vectors<V> operator+(const Vectors<V>& a, const Vectors<V>& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
template <typename V>
HWY_INLINE Vectors<V> operator*(V s, const Vectors<V>& v) {
  return {hn::Mul(s, v.x), hn::Mul(s, v.y), hn::Mul(s, v.z)};
}
/// Adds in Eigen's order on x86: floats x + (y + z), doubles (x + y) + z.
template <typename V>
HWY_INLINE V dot(const Vectors<V>& a, const Vectors<V>& b) {
  const V x = hn::Mul(a.x, b.x), y = hn::Mul(a.y, b.y), z = hn::Mul(a.z, b.z);
  if constexpr (std::is_same_v<hn::TFromV<V>, float>) return hn::Add(x, hn::Add(y, z));
  return hn::Add(hn::Add(x, y), z);
}
/// a b - c d.
template <typename V>
HWY_INLINE V cross(V a, V b, V c, V d) {
  return hn::Sub(hn::Mul(a, b), hn::Mul(c, d));
}
template <typename V>
HWY_INLINE Vectors<V> cross(const Vectors<V>& a, const Vectors<V>& b) {
  return {cross(a.y, b.z, a.z, b.y), cross(a.z, b.x, a.x, b.z), cross(a.x, b.y, a.y, b.x)};
}
template <typename M, typename V>
HWY_INLINE Vectors<V> choose(M mask, const Vectors<V>& yes, const Vectors<V>& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}

}  // namespace glovebench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
