#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <vector>

#include "core/cloud/labeled_cloud.h"
#include "core/database/look_up.h"
#include "core/pose/closest_point.h"
#include "core/pose/icp.h"

// What a user would take instead of our own: well-known libraries, each on one thread. bench/README.md says how
// each is used and what was not tried. Only bench/peers/ sees their headers. A constant below is null where this
// build lacks the library (GLOVEBENCH_PEERS).

namespace glovebench::bench {

/// Brute force over the database's fields of one size as inner products.
class LookUpPeer {
 public:
  virtual ~LookUpPeer() = default;
  /// The `keep` nearest entries of each query (tiny images of that size, none without glove pixels), best first;
  /// of equally near ones any.
  virtual std::vector<RecycledVector<Match>> operator()(std::span<const LabelImage> queries, int keep) = 0;
};
/// The database outlives the peer.
using MakeLookUpPeer = std::unique_ptr<LookUpPeer> (*)(const Database& database, int size);
extern const MakeLookUpPeer kFaiss, kOpenCv;

/// A tree for each color of a surface, asked for one point after the other.
class ClosestPointPeer {
 public:
  virtual ~ClosestPointPeer() = default;
  /// As `closest_points_plain`, but of equally close faces any. The points are the same ones in each call, moved a
  /// little: a point starts at its last face; at first, at that of the point of its color before it. Valid until
  /// the next call.
  virtual const RecycledVector<ClosestPoint>& operator()(std::span<const LabeledPoint> points_hand) = 0;
};
/// The surface outlives the peer.
using MakeClosestPointPeer = std::unique_ptr<ClosestPointPeer> (*)(const Surface& surface);
extern const MakeClosestPointPeer kEmbree, kCgal;

/// Aligns the points of a cloud (camera frame) with the faces that look at the camera in the start pose, point to
/// point. It knows no colors and no triangles: its model is a cloud of the faces' centers.
using AlignPeer = Alignment (*)(const Surface& surface, std::span<const LabeledPoint> points,
                                const Eigen::Isometry3d& T_camera_hand_coarse, const IcpConfig& config);
extern const AlignPeer kPcl;

}  // namespace glovebench::bench
