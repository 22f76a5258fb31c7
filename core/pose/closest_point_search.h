#pragma once

#include <array>
#include <span>

#include "core/pose/closest_point.h"
#include "core/pose/face_packets.h"
#include "core/pose/place_order.h"

namespace glovebench {

/// Neighboring points of one color.
struct PointGroup {
  static constexpr int kPoints = 16;  ///< at most

  int32_t points[kPoints];   ///< indices, padded with the last
  int32_t nearest[kPoints];  ///< distinct nearest faces of the last call, in FacePackets::faces
  int count = 0;
  int nearest_count = 0;  ///< 0 before the first call
  uint8_t label = 0;
};

struct GroupScratch {
  RecycledVector<uint8_t> is_measured;  ///< by face; 0 between groups
  RecycledVector<int32_t> candidates;
  RecycledVector<float> doubt;  ///< rounding error of each distance, m
};

/// Counts of all calls.
struct SearchWork {
  int64_t groups = 0;
  int64_t nearest = 0;  ///< distinct nearest faces per group
  int64_t measured = 0;
  int64_t boxes = 0;
};

/// Equals `closest_points_plain` bit for bit (very thin faces: within `Boxes::blur`). For one set of points that
/// moves little between calls. Later calls allocate nothing.
class ClosestPointSearch {
 public:
  ClosestPointSearch() = default;
  explicit ClosestPointSearch(const Surface& surface) { start(surface); }
  /// Copies the surface. Points start at their last faces if these remain.
  void start(const Surface& surface);
  /// Valid until the next call.
  const RecycledVector<ClosestPoint>& operator()(std::span<const LabeledPoint> points_hand);
  const SearchWork& work() const { return work_; }

 private:
  void keep_nearest_as_triangles();
  void find_nearest_of_triangles(const Surface& surface);
  void group(std::span<const LabeledPoint> points_hand);

  std::array<FacePackets, kColorCount + 1> colors_;
  std::array<RecycledVector<int32_t>, kColorCount + 1> triangles_;
  struct Place {
    int32_t face = -1;
    uint8_t label = 0;
  };
  RecycledVector<Place> places_;
  PlaceOrder order_;
  RecycledVector<uint8_t> labels_;
  RecycledVector<PointGroup> groups_;
  GroupScratch scratch_;
  RecycledVector<ClosestPoint> closest_;
  SearchWork work_;
};

}  // namespace glovebench
