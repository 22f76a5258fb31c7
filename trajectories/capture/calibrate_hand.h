#pragma once

#include <vector>

#include "trajectories/capture/capture_hand.h"

namespace glovebench::trajectories {

/// Palm joints, segment lengths and marker positions. 0: the nominal hand.
class HandParameters {
 public:
  explicit HandParameters(const CaptureHand& nominal);

  int size() const { return static_cast<int>(deviations_.size()); }
  /// Standard deviations between persons, m; segments relative.
  const Eigen::VectorXd& deviations() const { return deviations_; }
  /// Fix the hand frame: rows * parameters = 0, m.
  const Eigen::MatrixXd& frame_constraints() const { return frame_constraints_; }

  CaptureHand hand(const Eigen::VectorXd& parameters) const;
  /// Derivative of the markers (capture frame, three rows each) by the parameters.
  Eigen::MatrixXd jacobian(const CaptureHand& hand, const HandState& state) const;

 private:
  CaptureHand nominal_;
  Eigen::VectorXd deviations_;
  Eigen::MatrixXd frame_constraints_;
  std::array<int, kJointCount> first_of_joint_;
  std::vector<int> first_of_marker_;
};

struct Calibration {
  CaptureHand hand;
  std::vector<HandState> states;
};

/// Fits hand and states by damped Gauss-Newton (bundle adjustment) until a step gains less than `smallest_gain` of
/// the cost. `points`: [frame][marker], or gaps.
Calibration calibrate_hand(const CaptureHand& start, const std::vector<std::vector<Eigen::Vector3d>>& points,
                           const std::vector<HandState>& states, double robust_scale, double smallest_gain);

CaptureHand scaled(const CaptureHand& hand, double factor);

}  // namespace glovebench::trajectories
