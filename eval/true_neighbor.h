#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/database/database.h"
#include "core/hand/hand_model.h"

namespace glovebench::eval {

/// The entry of a database that a look-up should find.
struct TrueNeighbor {
  int entry = 0;
  double distance = 0;  ///< mean over all vertices of the distance between the two hands, m
};

/// Finds the entry whose hand lies nearest to a true one: the one with the smallest mean distance between equal
/// vertices of the two posed meshes. Of equal entries it is the smaller one.
///
/// Both hands have their origins at the same place and are seen along the ray through the middle of their bounding
/// square, which a look-up does not see: the true hand's rotation is turned by the smallest rotation that takes
/// this ray to the optical axis, the entry's by the one that takes its `box_ray` there, as core/pose/interpolate.h
/// does from one to the other.
///
/// Model and database must outlive the search. Immutable, shared between threads.
class TrueNeighborSearch {
 public:
  /// `model` is the hand that the database was made of.
  TrueNeighborSearch(const HandModel& model, const Database& database);

  /// The whole hand must lie in front of the camera.
  TrueNeighbor nearest(const Posture& posture, const Eigen::Isometry3d& T_camera_hand,
                       const PinholeCamera& camera) const;
  /// The same, vertex after vertex of every entry.
  TrueNeighbor nearest_plain(const Posture& posture, const Eigen::Isometry3d& T_camera_hand,
                             const PinholeCamera& camera) const;

 private:
  /// The posed hand in the frame of a camera that looks along the ray to it, origin at the hand's.
  Eigen::Matrix3Xd seen_along_ray(const Posture& posture, const Eigen::Isometry3d& T_camera_hand,
                                  const PinholeCamera& camera) const;
  /// One point a patch: the center of gravity of its vertices.
  Eigen::Matrix3Xd patch_centers(const Eigen::Matrix3Xd& vertices) const;
  int posture_of(int entry) const { return entry / kViewCount; }

  const HandModel& model_;
  std::vector<Eigen::Matrix3d> R_ray_hand_;      ///< of each entry
  std::vector<Eigen::Matrix3Xd> vertices_hand_;  ///< of each posture, m
  std::vector<Eigen::Matrix3Xd> centers_hand_;   ///< of each posture: those of the patches, m
  std::vector<int> patch_of_vertex_;
  Eigen::VectorXd vertex_weights_;  ///< all equal, sum 1
  Eigen::VectorXd patch_weights_;   ///< share of the vertices, sum 1
};

}  // namespace glovebench::eval
