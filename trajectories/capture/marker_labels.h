#pragma once

#include <Eigen/Core>
#include <vector>

namespace glovebench::trajectories {

/// A point farther than this from where a marker must be is not that marker, m.
inline constexpr double kLabelGate = 0.015;

/// The points of a frame, sorted anew.
struct Relabeling {
  std::vector<Eigen::Vector3d> points;  ///< one for each marker, or a gap
  int corrected = 0;  ///< markers whose point changed: another one's, an unlabeled one, or none now
};

/// Gives each marker the point that lies where the model says: the assignment with the least sum of squared
/// distances over all points of the frame, labeled or not. A marker's own point counts as half as far, so that
/// noise swaps nothing; what is beyond kLabelGate is nobody's. `predicted` and `labeled`: one for each marker.
Relabeling relabel(const std::vector<Eigen::Vector3d>& predicted, const std::vector<Eigen::Vector3d>& labeled,
                   const std::vector<Eigen::Vector3d>& unlabeled);

/// The column of each row with the least sum of costs, all different (Kuhn and Munkres). At least as many columns
/// as rows, finite costs.
std::vector<int> assign(const Eigen::MatrixXd& cost);

}  // namespace glovebench::trajectories
