#pragma once

#include <array>
#include <span>

#include "core/pose/closest_point.h"
#include "core/pose/face_packets.h"
#include "core/pose/place_order.h"

namespace glovebench {

/// Neighbors of one color, which are searched for together: a lane each.
struct PointGroup {
  static constexpr int kPoints = 16;  ///< at most; fewer where an instruction set has fewer lanes

  int32_t points[kPoints];   ///< their indices; the last one is repeated
  int32_t nearest[kPoints];  ///< the faces nearest to them at the last call, each once: in FacePackets::faces
  int count = 0;             ///< of the points
  int nearest_count = 0;     ///< 0 before the first call on a surface
  uint8_t label = 0;
};

/// What the search of one group makes on its way, with room for all faces of a color; reused.
struct GroupScratch {
  RecycledVector<uint8_t> is_measured;  ///< of each face; all 0 between two groups
  RecycledVector<int32_t> candidates;   ///< in FacePackets::faces
  RecycledVector<float> doubt;          ///< what rounding leaves in doubt of a candidate's distance, m
};

/// What a search did, over all its calls: says what it costs.
struct SearchWork {
  int64_t groups = 0;    ///< searched for
  int64_t nearest = 0;   ///< faces that are nearest to a point of a group: what no search can leave out
  int64_t measured = 0;  ///< faces, each against all points of a group
  int64_t boxes = 0;     ///< of faces, each against all points of a group
};

/// The answer of `closest_points_plain`, bit for bit and on every instruction set (on very thin faces as far as
/// `rounding_blur` bounds their rounding), faster. Points of a color that lie together are measured together
/// (Highway: a lane each): first against the faces that were nearest to any of them at the call before, then
/// against each face whose box is not farther from every one of them than the nearest so far. Nothing else is
/// remembered: what would say which faces to leave out takes as long to keep as to find again. One object follows
/// one set of points, which should move little from call to call and as a whole; it keeps its buffers, and after
/// the first call nothing is allocated.
class ClosestPointSearch {
 public:
  ClosestPointSearch() = default;
  explicit ClosestPointSearch(const Surface& surface) { start(surface); }
  /// Another surface, or others of its faces; the points may stay the same. The surface is copied. The faces that
  /// were nearest to points are measured first if they are still there: a hand that moves a little keeps them.
  void start(const Surface& surface);
  /// Valid until the next call.
  const RecycledVector<ClosestPoint>& operator()(std::span<const LabeledPoint> points_hand);
  const SearchWork& work() const { return work_; }

 private:
  /// Names the nearest faces of all groups by their triangles in the model; and back, those that the surface has.
  void keep_nearest_as_triangles();
  void find_nearest_of_triangles(const Surface& surface);
  /// Unless they have the labels that they had.
  void group(std::span<const LabeledPoint> points_hand);

  std::array<FacePackets, kColorCount + 1> colors_;
  std::array<RecycledVector<int32_t>, kColorCount + 1> triangles_;  ///< of the faces of each color
  struct Place {
    int32_t face = -1;  ///< in Surface::faces; -1 where the surface does not have the triangle
    uint8_t label = 0;
  };
  RecycledVector<Place> places_;    ///< of the triangles
  PlaceOrder order_;                ///< of the points
  RecycledVector<uint8_t> labels_;  ///< of the points that are grouped
  RecycledVector<PointGroup> groups_;
  GroupScratch scratch_;
  RecycledVector<ClosestPoint> closest_;
  SearchWork work_;
};

}  // namespace glovebench
