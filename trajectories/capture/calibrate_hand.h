#pragma once

#include <vector>

#include "trajectories/capture/capture_hand.h"

namespace glovebench::trajectories {

/// What makes one person's hand differ from another: where the joints of the palm lie, how long the segments are,
/// where the markers stick. All zero is the hand it was made from.
class HandParameters {
 public:
  explicit HandParameters(const CaptureHand& nominal);

  int size() const { return static_cast<int>(deviations_.size()); }
  /// Standard deviation of each parameter from person to person (m; of segments relative).
  const Eigen::VectorXd& deviations() const { return deviations_; }
  /// Rows that are zero times the parameters, m: the hand frame is that of core/README.md, midway between wrist and
  /// middle MCP and so on. Without them the palm's joints and the pose would drift against each other.
  const Eigen::MatrixXd& frame_constraints() const { return frame_constraints_; }

  CaptureHand hand(const Eigen::VectorXd& parameters) const;
  /// Derivative of the markers (capture frame) by the parameters: three rows a marker. `hand` is of those
  /// parameters.
  Eigen::MatrixXd jacobian(const CaptureHand& hand, const HandState& state) const;

 private:
  CaptureHand nominal_;
  Eigen::VectorXd deviations_;
  Eigen::MatrixXd frame_constraints_;
  std::array<int, kJointCount> first_of_joint_;  ///< parameter of a joint: three, or one of a segment's end
  std::vector<int> first_of_marker_;             ///< -1 of a joint center
};

struct Calibration {
  CaptureHand hand;
  std::vector<HandState> states;  ///< of the frames it was found from
};

/// The hand that fits all frames at once, and what it does in each: damped Gauss-Newton over the parameters and all
/// states together (bundle adjustment; the states are eliminated frame by frame). One after the other would creep:
/// a marker that sits farther round its finger looks like a bent joint until the joint moves. `points` of each
/// frame: one a marker, or a gap. Ends when a step gains less than `smallest_gain` of the cost.
Calibration calibrate_hand(const CaptureHand& start, const std::vector<std::vector<Eigen::Vector3d>>& points,
                           const std::vector<HandState>& states, double robust_scale, double smallest_gain);

/// All places of a hand times a factor.
CaptureHand scaled(const CaptureHand& hand, double factor);

}  // namespace glovebench::trajectories
