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

#include "core/pose/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glovebench::HWY_NAMESPACE {

constexpr hn::CappedTag<double, 8> kDoubles;
constexpr hn::Rebind<float, decltype(kDoubles)> kFloats;
constexpr size_t kLanes = hn::MaxLanes(kDoubles);
using Doubles = hn::VFromD<decltype(kDoubles)>;
using Floats = hn::VFromD<decltype(kFloats)>;
using DoubleVectors = Vectors<Doubles>;
using FloatVectors = Vectors<Floats>;

HWY_INLINE Doubles set(double value) { return hn::Set(kDoubles, value); }
HWY_INLINE FloatVectors load(const float (&v)[3][kLanes]) {
  return {hn::Load(kFloats, v[0]), hn::Load(kFloats, v[1]), hn::Load(kFloats, v[2])};
}
HWY_INLINE DoubleVectors promoted(const FloatVectors& v) {
  return {hn::PromoteTo(kDoubles, v.x), hn::PromoteTo(kDoubles, v.y), hn::PromoteTo(kDoubles, v.z)};
}
/// Divides by the length, unless that is 0.
template <typename V>
HWY_INLINE Vectors<V> normalized(const Vectors<V>& v) {
  const V squared = dot(v, v), length = hn::Sqrt(squared);
  const Vectors<V> divided{hn::Div(v.x, length), hn::Div(v.y, length), hn::Div(v.z, length)};
  return choose(hn::Gt(squared, hn::Zero(hn::DFromV<V>())), divided, v);
}

/// A face (a, b, c) per lane, a point p and its closest point q on the face.
struct PointsOnFaces {
  FloatVectors p, q, a, b, c;
};
/// One SurfacePull per lane.
struct SurfacePulls {
  DoubleVectors q, direction;
  Doubles distance_mm;
  DoubleVectors apart_mm;
  Doubles barycentric[3];
};
/// Repeats `surface_pull` exactly.
HWY_INLINE SurfacePulls surface_pulls(const PointsOnFaces& points) {
  const FloatVectors ab_float = points.b - points.a, ac_float = points.c - points.a;
  const DoubleVectors face_normal = promoted(normalized(cross(ab_float, ac_float)));
  const DoubleVectors ab = promoted(ab_float), ac = promoted(ac_float), aq = promoted(points.q - points.a);
  const DoubleVectors q = promoted(points.q), apart = promoted(points.p) - q, normal = cross(ab, ac);

  const Doubles area = dot(normal, normal);
  const auto has_area = hn::Gt(area, hn::Zero(kDoubles));
  const Doubles at_b = hn::IfThenElseZero(has_area, hn::Div(dot(cross(aq, ac), normal), area));
  const Doubles at_c = hn::IfThenElseZero(has_area, hn::Div(dot(cross(ab, aq), normal), area));
  const Doubles at_a = hn::Sub(hn::Sub(set(1), at_b), at_c);

  const Doubles length = hn::Sqrt(dot(apart, apart)), least = hn::Min(hn::Min(at_a, at_b), at_c);
  const auto is_along_the_line = hn::And(hn::Lt(least, set(kInsideFace)), hn::Gt(length, set(kNoDirection)));
  const DoubleVectors direction = choose(is_along_the_line, normalized(apart), face_normal);
  return {q, direction, hn::Mul(set(1000), dot(direction, apart)), set(1000) * apart, {at_a, at_b, at_c}};
}

/// The upper triangle by rows of a pull's weighted products, and its weighted row times its distance.
struct WeightedRows {
  Doubles products[21], sums[6];
};
/// A row for the motion along each pull.
HWY_INLINE WeightedRows along_direction(const SurfacePulls& pulls, Doubles weight) {
  WeightedRows result;
  const DoubleVectors turn = set(kMmPerDegree) * cross(pulls.q, pulls.direction), &shift = pulls.direction;
  const Doubles row[6] = {turn.x, turn.y, turn.z, shift.x, shift.y, shift.z};
  for (int i = 0, next = 0; i < 6; ++i) {
    const Doubles weighted = hn::Mul(weight, row[i]);
    result.sums[i] = hn::Mul(pulls.distance_mm, weighted);
    for (int j = i; j < 6; ++j) result.products[next++] = hn::Mul(weighted, row[j]);
  }
  return result;
}
/// Adds a row for each axis. The rows (a x e, e) of the axes e make (|a|^2 I - a a^T) of the turn, the cross
/// product's matrix between turn and shift, and I of the shift.
HWY_INLINE void add_along_axes(const SurfacePulls& pulls, Doubles weight, WeightedRows& rows) {
  const DoubleVectors a = set(kMmPerDegree) * pulls.q, w = weight * a;
  const Doubles square = dot(w, a);
  const auto add = [&](int i, Doubles value) HWY_ATTR { rows.products[i] = hn::Add(rows.products[i], value); };
  add(0, hn::Sub(square, hn::Mul(w.x, a.x)));
  add(1, hn::Neg(hn::Mul(w.x, a.y)));
  add(2, hn::Neg(hn::Mul(w.x, a.z)));
  add(4, hn::Neg(w.z));
  add(5, w.y);
  add(6, hn::Sub(square, hn::Mul(w.y, a.y)));
  add(7, hn::Neg(hn::Mul(w.y, a.z)));
  add(8, w.z);
  add(10, hn::Neg(w.x));
  add(11, hn::Sub(square, hn::Mul(w.z, a.z)));
  add(12, hn::Neg(w.y));
  add(13, w.x);
  for (const int i : {15, 18, 20}) add(i, weight);
  const DoubleVectors moment = cross(w, pulls.apart_mm), force = weight * pulls.apart_mm;
  const Doubles added[6] = {moment.x, moment.y, moment.z, force.x, force.y, force.z};
  for (int i = 0; i < 6; ++i) rows.sums[i] = hn::Add(rows.sums[i], added[i]);
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

  /// Adds the points to the sums and empties the block.
  HWY_INLINE void flush(std::span<const FaceBodies> faces, double tangential, BodySums& sums) {
    if (count_ == 0) return;
    const SurfacePulls pulls = surface_pulls({load(p_), load(q_), load(a_), load(b_), load(c_)});
    const Doubles weight = hn::Load(kDoubles, weight_);
    WeightedRows rows = along_direction(pulls, hn::Mul(weight, set(1 - tangential)));
    if (tangential > 0) add_along_axes(pulls, hn::Mul(weight, set(tangential)), rows);
    for (int i = 0; i < 21; ++i) hn::Store(rows.products[i], kDoubles, products_[i]);
    for (int i = 0; i < 6; ++i) hn::Store(rows.sums[i], kDoubles, sums_[i]);
    for (int c = 0; c < 3; ++c) hn::Store(pulls.barycentric[c], kDoubles, barycentric_[c]);
    for (size_t lane = 0; lane < count_; ++lane) add_lane(lane, faces[triangle_[lane]], sums);
    count_ = 0;
  }

 private:
  HWY_INLINE void add_lane(size_t lane, const FaceBodies& face, BodySums& sums) const {
    alignas(64) double products[BodySums::kProducts] = {}, row[BodySums::kRow] = {}, share[FaceBodies::kMost];
    for (int i = 0; i < 21; ++i) products[i] = products_[i][lane];
    for (int i = 0; i < 6; ++i) row[i] = sums_[i][lane];
    for (int i = 0; i < face.count; ++i) {
      share[i] = 0;
      for (int c = 0; c < 3; ++c) share[i] += barycentric_[c][lane] * static_cast<double>(face.share[c][i]);
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
  alignas(64) double products_[21][kLanes], sums_[6][kLanes], barycentric_[3][kLanes];
  uint32_t triangle_[kLanes];
  size_t count_ = 0;
};

void AddPulls(const MatchedPoints& matched, std::span<const FaceBodies> faces, const PullWeights& weights,
              BodySums& sums) {
  PullBlock block;
  for (size_t i = 0; i < matched.closest.size(); ++i) {
    const ClosestPoint& closest = matched.closest[i];
    if (closest.face < 0) continue;
    const double weight = tukey_weight(1000 * static_cast<double>(closest.distance), weights.tukey_mm);
    if (weight == 0) continue;
    const LabeledPoint& point = matched.points[i];
    block.add(point.p, closest.p_hand, matched.surface.faces(point.label)[closest.face], weight);
    if (block.is_full()) block.flush(faces, weights.tangential, sums);
  }
  block.flush(faces, weights.tangential, sums);
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

void PullSums::add(const MatchedPoints& matched, std::span<const FaceBodies> faces, const PullWeights& weights) {
  HWY_DYNAMIC_DISPATCH(AddPulls)(matched, faces, weights, sums_);
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
