#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/camera/pinhole_camera.h"
#include "core/database/database.h"
#include "core/hand/hand_model.h"

namespace glovebench::eval {

/// The entry that a look-up should find.
struct TrueNeighbor {
  int entry = 0;
  double distance = 0;  ///< mean over equal vertices, m
};

/// Finds the entry with the smallest mean vertex distance to a true hand. Ties go to the smaller entry. Hands are
/// compared at one origin and along one ray (`box_ray`). `model`: the database's hand. Both must outlive the
/// search. Thread-safe.
class TrueNeighborSearch {
 public:
  TrueNeighborSearch(const HandModel& model, const Database& database);

  /// The hand must be in front of the camera.
  TrueNeighbor nearest(const Posture& posture, const Eigen::Isometry3d& T_camera_hand,
                       const PinholeCamera& camera) const;
  /// Compares every vertex of every entry.
  TrueNeighbor nearest_plain(const Posture& posture, const Eigen::Isometry3d& T_camera_hand,
                             const PinholeCamera& camera) const;

 private:
  /// Vertices about the hand origin, with its ray turned to the optical axis.
  Eigen::Matrix3Xd seen_along_ray(const Posture& posture, const Eigen::Isometry3d& T_camera_hand,
                                  const PinholeCamera& camera) const;
  Eigen::Matrix3Xd patch_centers(const Eigen::Matrix3Xd& vertices) const;
  static int posture_of(int entry) { return entry / kViewCount; }

  const HandModel& model_;
  std::vector<Eigen::Matrix3d> R_ray_hand_;
  std::vector<Eigen::Matrix3Xd> vertices_hand_;  ///< m
  std::vector<Eigen::Matrix3Xd> centers_hand_;   ///< m
  std::vector<int> patch_of_vertex_;
  Eigen::VectorXd vertex_weights_;
  Eigen::VectorXd patch_weights_;
};

}  // namespace glovebench::eval
