#include "core/pose/closest_point_search.h"

#include <algorithm>
#include <bit>
#include <cmath>

// This file is compiled once for each instruction set whose vectors have a fixed size.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/pose/closest_point_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/pose/closest_on_faces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glovebench::HWY_NAMESPACE {

constexpr hn::CappedTag<float, FacePackets::kFaces> kFaceFloats;
constexpr hn::CappedTag<float, FacePackets::kPackets> kPacketFloats;
constexpr size_t kLanes = hn::MaxLanes(kFloats);

/// Relative rounding error of a distance or a bound: several times 2^-24.
constexpr float kShare = 1e-6f;

/// Around the points of a group.
struct GroupBox {
  float low[3], high[3];
  float diagonal;
};

HWY_INLINE GroupBox box_of(const FloatVectors& p) {
  GroupBox box;
  float squared = 0;
  const Floats axes[3] = {p.x, p.y, p.z};
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = hn::GetLane(hn::MinOfLanes(kFloats, axes[axis]));
    box.high[axis] = hn::GetLane(hn::MaxOfLanes(kFloats, axes[axis]));
    squared += (box.high[axis] - box.low[axis]) * (box.high[axis] - box.low[axis]);
  }
  box.diagonal = std::sqrt(squared);
  return box;
}

/// Distances of some boxes from a group.
template <typename D>
struct BoxesSeen {
  hn::VFromD<D> bound;  ///< smallest distance from the group
  hn::VFromD<D> doubt;  ///< rounding error of the distances between their faces and the points

  template <int kCount>
  HWY_INLINE BoxesSeen(D d, const Boxes<kCount>& boxes, size_t first, const GroupBox& group, float slack) {
    const auto apart = [&](int axis) HWY_ATTR {
      const auto below = hn::Sub(hn::Load(d, boxes.low[axis] + first), hn::Set(d, group.high[axis]));
      const auto above = hn::Sub(hn::Set(d, group.low[axis]), hn::Load(d, boxes.high[axis] + first));
      return hn::Max(hn::Zero(d), hn::Max(below, above));
    };
    const auto x = apart(0), y = apart(1), z = apart(2);
    const auto distance = hn::Sqrt(hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z))));
    const auto farthest = hn::Add(distance, hn::Set(d, group.diagonal));
    const auto reach = hn::Add(farthest, hn::Load(d, boxes.length + first));
    doubt = hn::MulAdd(hn::Load(d, boxes.blur + first), hn::Mul(reach, reach),
                       hn::MulAdd(hn::Set(d, kShare), farthest, hn::Set(d, slack)));
    bound = hn::Sub(distance, doubt);
  }
};

template <typename D>
HWY_INLINE uint32_t bits_of(D d, hn::Mask<D> mask) {
  uint8_t bits[8] = {};  // StoreMaskBits may write eight bytes
  hn::StoreMaskBits(d, mask, bits);
  return bits[0] | uint32_t{bits[1]} << 8;
}

/// The search of one group.
class GroupSearch {
 public:
  HWY_INLINE GroupSearch(const FacePackets& color, const FloatVectors& p, GroupScratch& scratch)
      : color_(color),
        p_(p),
        is_measured_(scratch.is_measured.data()),
        candidates_(scratch.candidates.data()),
        doubts_(scratch.doubt.data()) {}

  HWY_INLINE void measure(int32_t face) {
    nearest_.consider(p_, color_.faces[face]);
    is_measured_[face] = 1;
    ++measured_count_;
  }
  /// Measures all faces that may be nearer to a point than the nearest so far.
  HWY_INLINE void measure_near(SearchWork& work) {
    const Floats so_far =
        hn::MulAdd(hn::Sqrt(nearest_.squared), hn::Set(kFloats, 1 + kShare), hn::Set(kFloats, color_.slack));
    const int listed = list_near(hn::GetLane(hn::MaxOfLanes(kFloats, so_far)));
    int count = 0;
    for (int i = 0; i < listed; ++i) {  // no branch, because it could not be predicted
      const int32_t face = candidates_[i];
      candidates_[count] = face;
      count += is_near(face, hn::Add(so_far, hn::Set(kFloats, doubts_[i])));
    }
    for (int i = 0; i < count; ++i) nearest_.consider(p_, color_.faces[candidates_[i]]);
    work.measured += measured_count_ + count;
    work.boxes += listed;
  }
  const Nearest& nearest() const { return nearest_; }

 private:
  /// Lists the faces whose box is within `limit` of the group's box. Returns their number.
  HWY_INLINE int list_near(float limit) {
    const GroupBox box = box_of(p_);
    int listed = 0;
    for (int first = 0; first < color_.packet_count(); first += FacePackets::kPackets) {
      uint32_t near = 0;
      for (size_t i = 0; i < FacePackets::kPackets; i += hn::Lanes(kPacketFloats)) {
        const BoxesSeen seen(kPacketFloats, color_.packet_boxes[first / FacePackets::kPackets], i, box,
                             color_.slack);
        near |= bits_of(kPacketFloats, hn::Not(hn::Gt(seen.bound, hn::Set(kPacketFloats, limit)))) << i;
      }
      for (near &= (2u << std::min(15, color_.packet_count() - 1 - first)) - 1; near != 0; near &= near - 1)
        listed = list_packet(first + std::countr_zero(near), box, limit, listed);
    }
    return listed;
  }
  HWY_INLINE int list_packet(int packet, const GroupBox& box, float limit, int listed) {
    for (size_t first = 0; first < FacePackets::kFaces; first += hn::Lanes(kFaceFloats)) {
      const BoxesSeen seen(kFaceFloats, color_.face_boxes[packet], first, box, color_.slack);
      alignas(64) float doubt[hn::MaxLanes(kFaceFloats)];
      hn::Store(seen.doubt, kFaceFloats, doubt);
      const uint32_t near = bits_of(kFaceFloats, hn::Not(hn::Gt(seen.bound, hn::Set(kFaceFloats, limit))));
      for (size_t i = 0; i < hn::Lanes(kFaceFloats); ++i) {  // no branch, and no CompressStore: it copies a table
        candidates_[listed] = packet * FacePackets::kFaces + static_cast<int32_t>(first + i);
        doubts_[listed] = doubt[i];
        listed += static_cast<int>(near >> i & 1);
      }
    }
    return listed;
  }
  /// True if the face was not measured and its box is within `limit` of any point.
  HWY_INLINE int is_near(int32_t face, Floats limit) const {
    const Boxes<FacePackets::kFaces>& boxes = color_.face_boxes[face / FacePackets::kFaces];
    const int i = face % FacePackets::kFaces;
    const auto apart = [&](int axis, Floats at) HWY_ATTR {
      const Floats below = hn::Sub(hn::Set(kFloats, boxes.low[axis][i]), at);
      const Floats above = hn::Sub(at, hn::Set(kFloats, boxes.high[axis][i]));
      return hn::Max(hn::Zero(kFloats), hn::Max(below, above));
    };
    const Floats x = apart(0, p_.x), y = apart(1, p_.y), z = apart(2, p_.z);
    const Floats squared = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
    return !hn::AllTrue(kFloats, hn::Gt(squared, hn::Mul(limit, limit))) & !is_measured_[face];
  }

  const FacePackets& color_;
  const FloatVectors& p_;
  uint8_t* is_measured_;
  int32_t* candidates_;
  float* doubts_;
  Nearest nearest_;
  int measured_count_ = 0;  ///< by `measure`
};

HWY_INLINE FloatVectors gather(std::span<const LabeledPoint> points, const PointGroup& group) {
  alignas(64) float p[3][kLanes];
  const LabeledPoint* const all = points.data();
  for (size_t i = 0; i < kLanes; ++i)
    for (int axis = 0; axis < 3; ++axis) p[axis][i] = all[group.points[i]].p[axis];
  return {hn::Load(kFloats, p[0]), hn::Load(kFloats, p[1]), hn::Load(kFloats, p[2])};
}

/// Writes the results, and the group's nearest faces for the next call.
HWY_INLINE void scatter(const Nearest& nearest, uint8_t* noted, PointGroup& group, ClosestPoint* results) {
  alignas(64) float p[3][kLanes], distance[kLanes];
  alignas(64) int32_t face[kLanes];
  hn::Store(nearest.p.x, kFloats, p[0]);
  hn::Store(nearest.p.y, kFloats, p[1]);
  hn::Store(nearest.p.z, kFloats, p[2]);
  const Mask none = hn::Eq(nearest.squared, hn::Set(kFloats, kInfinity));
  hn::Store(hn::IfThenZeroElse(none, hn::Sqrt(nearest.squared)), kFloats, distance);
  hn::Store(nearest.face, kInts, face);
  group.nearest_count = 0;
  for (int i = 0; i < group.count; ++i) {
    results[group.points[i]] = {Eigen::Vector3f(p[0][i], p[1][i], p[2][i]), distance[i], face[i]};
    const int32_t nearest_face = std::max(0, face[i]);
    group.nearest[group.nearest_count] = nearest_face;
    group.nearest_count += !noted[nearest_face];
    noted[nearest_face] = 1;
  }
  for (int i = 0; i < group.nearest_count; ++i) noted[group.nearest[i]] = 0;
}

void FindClosest(const FacePackets* colors, std::span<const LabeledPoint> points, std::span<PointGroup> groups,
                 GroupScratch& scratch, ClosestPoint* results, SearchWork& work) {
  const PointGroup* before = nullptr;
  for (PointGroup& group : groups) {
    const FacePackets& color = colors[group.label];
    if (color.faces.empty()) {
      for (int i = 0; i < group.count; ++i) results[group.points[i]] = {};
      continue;
    }
    const FloatVectors p = gather(points, group);
    GroupSearch search(color, p, scratch);
    // The first call starts at the faces of the previous group, a neighbor, or else at a face of each packet.
    const bool has_neighbor = before != nullptr && before->label == group.label;
    const PointGroup& start = group.nearest_count > 0 || !has_neighbor ? group : *before;
    for (int i = 0; i < start.nearest_count; ++i) search.measure(start.nearest[i]);
    if (start.nearest_count == 0)
      for (size_t face = 0; face < color.faces.size(); face += FacePackets::kFaces) search.measure(face);
    search.measure_near(work);
    std::fill_n(scratch.is_measured.begin(), color.faces.size(), 0);
    scatter(search.nearest(), scratch.is_measured.data(), group, results);
    ++work.groups;
    work.nearest += group.nearest_count;
    before = &group;
  }
}

size_t LaneCount() { return kLanes; }

}  // namespace glovebench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glovebench {
namespace {
HWY_EXPORT(FindClosest);
HWY_EXPORT(LaneCount);
}  // namespace

void ClosestPointSearch::keep_nearest_as_triangles() {
  for (PointGroup& group : groups_)
    for (int i = 0; i < group.nearest_count; ++i) group.nearest[i] = triangles_[group.label][group.nearest[i]];
}

void ClosestPointSearch::find_nearest_of_triangles(const Surface& surface) {
  places_.clear();
  for (uint8_t label = 0; label < static_cast<uint8_t>(colors_.size()); ++label) {
    triangles_[label].clear();
    for (const Surface::Face& face : surface.faces(label)) {
      if (places_.size() <= face.triangle) places_.resize(face.triangle + 1);
      places_[face.triangle] = {static_cast<int32_t>(triangles_[label].size()), label};
      triangles_[label].push_back(static_cast<int32_t>(face.triangle));
    }
  }
  for (PointGroup& group : groups_) {
    int kept = 0;
    for (int i = 0; i < group.nearest_count; ++i) {
      const auto triangle = static_cast<size_t>(group.nearest[i]);
      if (triangle < places_.size() && places_[triangle].face >= 0 && places_[triangle].label == group.label)
        group.nearest[kept++] = places_[triangle].face;
    }
    group.nearest_count = kept;
  }
}

void ClosestPointSearch::start(const Surface& surface) {
  keep_nearest_as_triangles();
  size_t most = 0;
  for (uint8_t label = 0; label < static_cast<uint8_t>(colors_.size()); ++label) {
    colors_[label].assign(surface.faces(label));
    most = std::max(most, colors_[label].faces.size());
  }
  scratch_.is_measured.assign(most, 0);
  constexpr size_t kBehind = FacePackets::kFaces;  // where a compressing store may write
  scratch_.candidates.resize(most + kBehind);
  scratch_.doubt.resize(most + kBehind);
  find_nearest_of_triangles(surface);
}

void ClosestPointSearch::group(std::span<const LabeledPoint> points_hand) {
  if (std::ranges::equal(points_hand, labels_, {}, &LabeledPoint::label)) return;
  labels_.clear();
  for (const LabeledPoint& point : points_hand) labels_.push_back(point.label);
  const size_t lanes = HWY_DYNAMIC_DISPATCH(LaneCount)();
  groups_.clear();
  std::span<const uint32_t> order = order_(points_hand);
  while (!order.empty()) {
    PointGroup& group = groups_.emplace_back();
    group.label = points_hand[order.front()].label;
    while (group.count < static_cast<int>(lanes) && !order.empty() &&
           points_hand[order.front()].label == group.label) {
      group.points[group.count++] = static_cast<int32_t>(order.front());
      order = order.subspan(1);
    }
    std::fill(group.points + group.count, group.points + lanes, group.points[group.count - 1]);
  }
}

const RecycledVector<ClosestPoint>& ClosestPointSearch::operator()(std::span<const LabeledPoint> points_hand) {
  group(points_hand);
  closest_.resize(points_hand.size());
  HWY_DYNAMIC_DISPATCH(FindClosest)(colors_.data(), points_hand, groups_, scratch_, closest_.data(), work_);
  return closest_;
}

}  // namespace glovebench
#endif
