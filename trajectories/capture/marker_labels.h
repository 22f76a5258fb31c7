#pragma once

#include <Eigen/Core>
#include <vector>

namespace glovebench::trajectories {

/// Largest distance of a marker's point from its prediction, m.
inline constexpr double kLabelGate = 0.015;

struct Relabeling {
  std::vector<Eigen::Vector3d> points;  ///< by marker, or a gap
  int corrected = 0;                    ///< markers that changed or lost their point
};

/// Assigns points within kLabelGate to markers by the least sum of squared distances. A marker's own point counts
/// as half as far, so that noise swaps nothing. `predicted`, `labeled`: by marker.
Relabeling relabel(const std::vector<Eigen::Vector3d>& predicted, const std::vector<Eigen::Vector3d>& labeled,
                   const std::vector<Eigen::Vector3d>& unlabeled);

/// Distinct columns for the rows with the least sum of finite costs (Kuhn and Munkres). At most as many rows as
/// columns.
std::vector<int> assign(const Eigen::MatrixXd& cost);

}  // namespace glovebench::trajectories
