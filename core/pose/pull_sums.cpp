#include "core/pose/pull_sums.h"

#include <algorithm>
#include <bit>

#include "core/base/error.h"

// This file is compiled once for each instruction set whose vectors have a fixed size.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/pose/pull_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace glovebench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<double, 8> kDoubles;
constexpr hn::Rebind<float, decltype(kDoubles)> kFloats;
constexpr size_t kLanes = hn::MaxLanes(kDoubles);
using Doubles = hn::VFromD<decltype(kDoubles)>;
using Floats = hn::VFromD<decltype(kFloats)>;

template <typename V>
struct Vectors {
  V x, y, z;
};
template <typename V>
HWY_INLINE V product_difference(V a, V b, V c, V d) {
  return hn::Sub(hn::Mul(a, b), hn::Mul(c, d));
}
template <typename V>
HWY_INLINE Vectors<V> cross(const Vectors<V>& a, const Vectors<V>& b) {
  return {product_difference(a.y, b.z, a.z, b.y), product_difference(a.z, b.x, a.x, b.z),
          product_difference(a.x, b.y, a.y, b.x)};
}
/// Adds in Eigen's order on x86: floats x + (y + z), doubles (x + y) + z.
HWY_INLINE Floats dot(const Vectors<Floats>& a, const Vectors<Floats>& b) {
  return hn::Add(hn::Mul(a.x, b.x), hn::Add(hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)));
}
HWY_INLINE Doubles dot(const Vectors<Doubles>& a, const Vectors<Doubles>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
template <typename V>
HWY_INLINE Vectors<V> scaled(V s, const Vectors<V>& v) {
  return {hn::Mul(s, v.x), hn::Mul(s, v.y), hn::Mul(s, v.z)};
}
/// Of length 1; as it is if its square is 0.
template <typename D>
HWY_INLINE Vectors<hn::VFromD<D>> normalized(D d, const Vectors<hn::VFromD<D>>& v) {
  const auto squared = dot(v, v), length = hn::Sqrt(squared);
  const auto has_length = hn::Gt(squared, hn::Zero(d));
  return {hn::IfThenElse(has_length, hn::Div(v.x, length), v.x),
          hn::IfThenElse(has_length, hn::Div(v.y, length), v.y),
          hn::IfThenElse(has_length, hn::Div(v.z, length), v.z)};
}
HWY_INLINE Vectors<Doubles> promoted(const Vectors<Floats>& v) {
  return {hn::PromoteTo(kDoubles, v.x), hn::PromoteTo(kDoubles, v.y), hn::PromoteTo(kDoubles, v.z)};
}

/// One point per lane.
class PullBlock {
 public:
  HWY_INLINE void add(const Eigen::Vector3f& p, const Eigen::Vector3f& q, const Surface::Face& face,
                      double weight) {
    for (int axis = 0; axis < 3; ++axis) {
      p_[axis][count_] = p[axis];
      q_[axis][count_] = q[axis];
      a_[axis][count_] = face.a[axis];
      b_[axis][count_] = face.b[axis];
      c_[axis][count_] = face.c[axis];
    }
    weight_[count_] = weight;
    triangle_[count_++] = face.triangle;
  }
  HWY_INLINE bool is_full() const { return count_ == kLanes; }

  /// Repeats `surface_pull` exactly, and empties the block.
  HWY_INLINE void sum(std::span<const FaceBodies> faces, double tangential, BodySums& sums) {
    if (count_ == 0) return;
    const auto load = [](const float(&v)[3][kLanes]) HWY_ATTR {
      return Vectors<Floats>{hn::Load(kFloats, v[0]), hn::Load(kFloats, v[1]), hn::Load(kFloats, v[2])};
    };
    const auto minus = [](const auto& u, const auto& v) HWY_ATTR {
      return std::decay_t<decltype(u)>{hn::Sub(u.x, v.x), hn::Sub(u.y, v.y), hn::Sub(u.z, v.z)};
    };
    const auto set = [](double value) HWY_ATTR { return hn::Set(kDoubles, value); };
    const auto q_float = load(q_), a = load(a_), ab_float = minus(load(b_), a), ac_float = minus(load(c_), a);
    const auto normal_float = cross(ab_float, ac_float);
    const auto face_normal = promoted(normalized(kFloats, normal_float));
    const auto q = promoted(q_float), apart = minus(promoted(load(p_)), q);
    const auto ab = promoted(ab_float), ac = promoted(ac_float), aq = promoted(minus(q_float, a));

    const auto normal = cross(ab, ac);
    const Doubles area = dot(normal, normal), one = set(1);
    const auto has_area = hn::Gt(area, hn::Zero(kDoubles));
    Doubles at_b = hn::IfThenElseZero(has_area, hn::Div(dot(cross(aq, ac), normal), area));
    Doubles at_c = hn::IfThenElseZero(has_area, hn::Div(dot(cross(ab, aq), normal), area));
    const Doubles at_a = hn::Sub(hn::Sub(one, at_b), at_c);

    const Doubles length = hn::Sqrt(dot(apart, apart)), least = hn::Min(hn::Min(at_a, at_b), at_c);
    const auto is_along_the_line = hn::And(hn::Lt(least, set(kInsideFace)), hn::Gt(length, set(kNoDirection)));
    const auto line = normalized(kDoubles, apart);
    const Vectors<Doubles> direction{hn::IfThenElse(is_along_the_line, line.x, face_normal.x),
                                     hn::IfThenElse(is_along_the_line, line.y, face_normal.y),
                                     hn::IfThenElse(is_along_the_line, line.z, face_normal.z)};
    const Doubles distance_mm = hn::Mul(set(1000), dot(direction, apart));

    const auto turn = scaled(set(kMmPerDegree), cross(q, direction));
    const Doubles row[6] = {turn.x, turn.y, turn.z, direction.x, direction.y, direction.z};
    const Doubles whole = hn::Load(kDoubles, weight_), weight = hn::Mul(whole, set(1 - tangential));
    Doubles products[21], sum[6];
    for (int i = 0, next = 0; i < 6; ++i) {
      const Doubles weighted = hn::Mul(weight, row[i]);
      sum[i] = hn::Mul(distance_mm, weighted);
      for (int j = i; j < 6; ++j) products[next++] = hn::Mul(weighted, row[j]);
    }
    if (tangential > 0) {
      // The rows (a x e, e) of the axes e make (|a|^2 I - a a^T) of the turn, the cross product's matrix between
      // the two, and I of the shift.
      const Doubles along = hn::Mul(whole, set(tangential));
      const auto arm = scaled(set(kMmPerDegree), q), w = scaled(along, arm), apart_mm = scaled(set(1000), apart);
      const Doubles square = dot(w, arm);
      const auto add = [&](int i, Doubles value) HWY_ATTR { products[i] = hn::Add(products[i], value); };
      add(0, hn::Sub(square, hn::Mul(w.x, arm.x)));
      add(1, hn::Neg(hn::Mul(w.x, arm.y)));
      add(2, hn::Neg(hn::Mul(w.x, arm.z)));
      add(4, hn::Neg(w.z));
      add(5, w.y);
      add(6, hn::Sub(square, hn::Mul(w.y, arm.y)));
      add(7, hn::Neg(hn::Mul(w.y, arm.z)));
      add(8, w.z);
      add(10, hn::Neg(w.x));
      add(11, hn::Sub(square, hn::Mul(w.z, arm.z)));
      add(12, hn::Neg(w.y));
      add(13, w.x);
      for (const int i : {15, 18, 20}) add(i, along);
      const auto moment = cross(w, apart_mm), force = scaled(along, apart_mm);
      const Doubles added[6] = {moment.x, moment.y, moment.z, force.x, force.y, force.z};
      for (int i = 0; i < 6; ++i) sum[i] = hn::Add(sum[i], added[i]);
    }
    const Doubles barycentric[3] = {at_a, at_b, at_c};
    for (int i = 0; i < 21; ++i) hn::Store(products[i], kDoubles, by_lane_[i]);
    for (int i = 0; i < 6; ++i) hn::Store(sum[i], kDoubles, by_lane_[kSum + i]);
    for (int c = 0; c < 3; ++c) hn::Store(barycentric[c], kDoubles, by_lane_[kBarycentric + c]);
    for (size_t lane = 0; lane < count_; ++lane) add_lane(lane, faces[triangle_[lane]], sums);
    count_ = 0;
  }

 private:
  static constexpr int kSum = 21, kBarycentric = 27;

  HWY_INLINE void add_lane(size_t lane, const FaceBodies& face, BodySums& sums) const {
    alignas(64) double products[BodySums::kProducts] = {}, row[BodySums::kRow] = {}, share[FaceBodies::kMost];
    for (int i = 0; i < 21; ++i) products[i] = by_lane_[i][lane];
    for (int i = 0; i < 6; ++i) row[i] = by_lane_[kSum + i][lane];
    for (int i = 0; i < face.count; ++i) {
      share[i] = 0;
      for (int c = 0; c < 3; ++c)
        share[i] += by_lane_[kBarycentric + c][lane] * static_cast<double>(face.share[c][i]);
    }
    for (int i = 0; i < face.count; ++i) {
      std::array<double, BodySums::kRow>& of_body = sums.rows[face.body[i]];
      for (size_t k = 0; k < BodySums::kRow; ++k) of_body[k] += share[i] * row[k];
      for (int j = 0; j <= i; ++j) {
        const auto [low, high] = std::minmax(face.body[i], face.body[j]);
        std::array<double, BodySums::kProducts>& of_pair = sums.of_pair(low, high);
        const double both = share[i] * share[j];
        for (size_t k = 0; k < BodySums::kProducts; ++k) of_pair[k] += both * products[k];
      }
    }
  }

  alignas(64) float p_[3][kLanes] = {}, q_[3][kLanes] = {}, a_[3][kLanes] = {}, b_[3][kLanes] = {},
                    c_[3][kLanes] = {};
  alignas(64) double weight_[kLanes] = {};
  alignas(64) double by_lane_[kBarycentric + 3][kLanes];
  uint32_t triangle_[kLanes];
  size_t count_ = 0;
};

void AddPulls(const MatchedPoints& matched, std::span<const FaceBodies> faces, double tukey_mm, double tangential,
              BodySums& sums) {
  PullBlock block;
  for (size_t i = 0; i < matched.closest.size(); ++i) {
    const ClosestPoint& closest = matched.closest[i];
    if (closest.face < 0) continue;
    const double weight = tukey_weight(1000 * static_cast<double>(closest.distance), tukey_mm);
    if (weight == 0) continue;
    const LabeledPoint& point = matched.points[i];
    block.add(point.p, closest.p_hand, matched.surface.faces(point.label)[closest.face], weight);
    if (block.is_full()) block.sum(faces, tangential, sums);
  }
  block.sum(faces, tangential, sums);
}

}  // namespace glovebench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glovebench {
namespace {
HWY_EXPORT(AddPulls);

FaceBodies bodies_of_face(const std::array<uint32_t, 3>& corners, std::span<const BodyShares> shares) {
  FaceBodies face;
  for (uint8_t body = 0; body < kBodyCount; ++body) {
    std::array<float, 3> of_corners;
    for (int c = 0; c < 3; ++c) of_corners[c] = shares[corners[c]][body];
    if (of_corners == std::array<float, 3>{0, 0, 0}) continue;
    check(face.count < FaceBodies::kMost, "the corners of a face hang on eight bodies at most");
    for (int c = 0; c < 3; ++c) face.share[c][face.count] = of_corners[c];
    face.body[face.count++] = body;
  }
  return face;
}

}  // namespace

std::vector<FaceBodies> face_bodies(const HandModel& model, std::span<const BodyShares> shares) {
  std::vector<FaceBodies> faces;
  for (const Triangle& triangle : model.triangles()) faces.push_back(bodies_of_face(triangle.vertices, shares));
  return faces;
}

PullSums::PullSums(const std::array<Screw, kAngleCount>& screws) {
  for (int a = 0; a < kAngleCount; ++a) screws_[a] = on_rows(screws[a]);
}

void PullSums::add(const Pull& pull, const BodyShares& shares) {
  const Vector6d row = row_of(pull), weighted = pull.weight * row;
  for (int high = 0; high < kBodyCount; ++high) {
    if (shares[high] == 0) continue;
    const auto of_high = static_cast<double>(shares[high]);
    for (int i = 0; i < 6; ++i) sums_.rows[high][i] += of_high * (pull.distance_mm * weighted[i]);
    for (int low = 0; low <= high; ++low) {
      if (shares[low] == 0) continue;
      const double both = of_high * static_cast<double>(shares[low]);
      std::array<double, BodySums::kProducts>& of_pair = sums_.of_pair(low, high);
      for (int i = 0, next = 0; i < 6; ++i)
        for (int j = i; j < 6; ++j) of_pair[next++] += both * (weighted[i] * row[j]);
    }
  }
}

void PullSums::add(const MatchedPoints& matched, std::span<const FaceBodies> faces, double tukey_mm,
                   double tangential) {
  HWY_DYNAMIC_DISPATCH(AddPulls)(matched, faces, tukey_mm, tangential, sums_);
}

NormalEquations PullSums::equations() const {
  using Matrix6d = Eigen::Matrix<double, 6, 6>;
  NormalEquations result;
  std::array<Matrix6d, kBodyCount> of_bodies;  // the body's products with all bodies
  of_bodies.fill(Matrix6d::Zero());
  for (int high = 0; high < kBodyCount; ++high) {
    for (int low = 0; low <= high; ++low) {
      const int pair = BodySums::pair_of(low, high);
      if (!sums_.is_used[pair]) continue;
      Matrix6d S;
      for (int i = 0, next = 0; i < 6; ++i)
        for (int j = i; j < 6; ++j) S(i, j) = S(j, i) = sums_.products[pair][next++];
      of_bodies[high] += S;
      if (low != high) of_bodies[low] += S;
      for (uint32_t b = angles_of_body(high); b != 0; b &= b - 1) {
        const int right = std::countr_zero(b);
        const Vector6d moved_by = S * screws_[right];
        for (uint32_t a = angles_of_body(low); a != 0; a &= a - 1) {
          const int left = std::countr_zero(a);
          const double product = screws_[left].dot(moved_by);
          result.H(6 + left, 6 + right) += product;
          if (low != high) result.H(6 + right, 6 + left) += product;
        }
      }
    }
  }
  for (int body = 0; body < kBodyCount; ++body) {
    const Vector6d sum = Eigen::Map<const Vector6d>(sums_.rows[body].data());
    result.H.topLeftCorner<6, 6>() += of_bodies[body];
    result.g.head<6>() += sum;
    for (uint32_t a = angles_of_body(body); a != 0; a &= a - 1) {
      const int angle = std::countr_zero(a);
      result.H.col(6 + angle).head<6>() += of_bodies[body] * screws_[angle];
      result.g[6 + angle] += screws_[angle].dot(sum);
    }
  }
  result.H.bottomLeftCorner<kAngleCount, 6>() = result.H.topRightCorner<6, kAngleCount>().transpose();
  return result;
}

}  // namespace glovebench
#endif
