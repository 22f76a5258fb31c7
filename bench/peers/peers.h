#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/cloud/labeled_cloud.h"
#include "core/database/look_up.h"
#include "core/database/look_up_parts.h"
#include "core/pose/alignment.h"
#include "core/pose/closest_point.h"

// Other libraries, each on one thread (bench/README.md). Null without GLOVEBENCH_PEERS.

namespace glovebench::bench {

/// Searches the images of one size.
class LookUpPeer {
 public:
  virtual ~LookUpPeer() = default;
  /// The `keep` nearest entries, best first, ties in any order. The query must have glove pixels.
  virtual RecycledVector<Match> look_up(const LabelImage& query, int keep) = 0;
  virtual std::vector<RecycledVector<Match>> look_up_all(std::span<const LabelImage> queries, int keep) {
    std::vector<RecycledVector<Match>> matches;
    for (const LabelImage& query : queries) matches.push_back(look_up(query, keep));
    return matches;
  }
  /// Numbers that the last call added or multiplied, per query.
  double work() const { return work_; }

 protected:
  static RecycledVector<Match> nearest(RecycledVector<Candidate> candidates, int keep, size_t glove_pixels) {
    std::partial_sort(candidates.begin(), candidates.begin() + keep, candidates.end());
    candidates.resize(keep);
    return matches_of(candidates, glove_pixels);
  }

  double work_ = 0;
};
/// `database` must outlive the peer.
using MakeLookUpPeer = std::unique_ptr<LookUpPeer> (*)(const Database& database, int size);
template <typename Peer>
std::unique_ptr<LookUpPeer> make_look_up(const Database& database, int size) {
  return std::make_unique<Peer>(database, size);
}
/// Exact search.
extern const MakeLookUpPeer kFaiss, kFaissBytes, kOpenCv, kSparse, kSparseRows;
/// Approximate search.
extern const MakeLookUpPeer kFaiss8Bit, kFaissPq, kFaissHnsw;

class ClosestPointPeer {
 public:
  virtual ~ClosestPointPeer() = default;
  /// As `closest_points_plain`, with any of equally near faces. Pass the same points, moved a little. Valid until
  /// the next call.
  virtual const RecycledVector<ClosestPoint>& operator()(std::span<const LabeledPoint> points_hand) = 0;
};
/// `surface` must outlive the peer.
using MakeClosestPointPeer = std::unique_ptr<ClosestPointPeer> (*)(const Surface& surface);
template <typename Peer>
std::unique_ptr<ClosestPointPeer> make_search(const Surface& surface) {
  return std::make_unique<Peer>(surface);
}
extern const MakeClosestPointPeer kEmbree, kCgal;

/// Uses centers of faces seen at the start, without colors.
using AlignPeer = Alignment (*)(const Surface& surface, std::span<const LabeledPoint> points,
                                const Eigen::Isometry3d& T_camera_hand_coarse, const IcpConfig& config);
extern const AlignPeer kPcl;

/// Starts a search at the last face of the point, or of the previous one of its color.
class WarmStart {
 public:
  /// The closest point there, or face -1. `last`: the point's last result, or face -1.
  ClosestPoint operator()(const LabeledPoint& point, const ClosestPoint& last, const Surface& surface) const {
    const int face = last.face >= 0 ? last.face : faces_[point.label];
    if (face < 0) return {};
    const Eigen::Vector3f p = closest_on_triangle(point.p, surface.faces(point.label)[face]);
    return {p, (p - point.p).norm(), face};
  }
  void found(const LabeledPoint& point, const ClosestPoint& closest) { faces_[point.label] = closest.face; }

 private:
  std::array<int, kColorCount + 1> faces_ = [] {
    std::array<int, kColorCount + 1> none;
    none.fill(-1);
    return none;
  }();
};

}  // namespace glovebench::bench
