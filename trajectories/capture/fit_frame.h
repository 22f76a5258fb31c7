#pragma once

#include <array>
#include <vector>

#include "core/base/math.h"
#include "trajectories/capture/capture_hand.h"

namespace glovebench::trajectories {

struct PosturePrior {
  Posture center = Posture::Zero();  ///< rad
  double deviation = radians_from_degrees(60);
  /// from kEndJointShare of the middle joint, rad
  double end_joint_deviation = radians_from_degrees(15);
};

double prior_cost(const Posture& posture, const PosturePrior& prior);
void add_prior(const Posture& posture, const PosturePrior& prior, Eigen::Ref<Eigen::MatrixXd> H,
               Eigen::Ref<Eigen::VectorXd> b);

/// Unit of costs, m.
inline constexpr double kPointDeviation = 0.001;

struct FrameFitOptions {
  /// weights (Cauchy) fall from this distance, m
  double robust_scale = 0.003;
  int max_iterations = 40;
};

struct WeightedResiduals {
  Eigen::VectorXd residuals;  ///< three per marker, weighted, in kPointDeviation; 0: unseen
  Eigen::VectorXd row_scale;  ///< from m to `residuals`; 0: unseen
  double cost = 0;
};
/// `points`: a point or gap per marker.
WeightedResiduals weighted_residuals(const CaptureHand& hand, const std::vector<Eigen::Vector3d>& points,
                                     const HandState& state, double robust_scale);

/// Fixes angles whose step would cross a limit.
void hold_at_limits(const HandState& state, Eigen::Ref<Eigen::MatrixXd> H, Eigen::Ref<Eigen::VectorXd> b);

struct FrameFit {
  HandState state;
  double cost = 0;
};

/// Damped Gauss-Newton with Cauchy's weights, joint limits and a prior about `start`.
FrameFit fit_frame(const CaptureHand& hand, const std::vector<Eigen::Vector3d>& points, const HandState& start,
                   const FrameFitOptions& options = {});

/// m; NaN for gaps.
std::vector<double> point_distances(const CaptureHand& hand, const std::vector<Eigen::Vector3d>& points,
                                    const HandState& state);

struct Observability {
  bool pose = false;
  std::array<bool, kAngleCount> angles = {};
};
/// An angle is observable if points with kPointDeviation determine it to this.
inline constexpr double kShownDeviation = radians_from_degrees(15);
Observability observability(const CaptureHand& hand, const std::vector<Eigen::Vector3d>& points,
                            const HandState& state, double robust_scale);

struct Bridged {
  std::vector<HandState> states;
  std::vector<std::array<bool, kAngleCount>> angles;
  std::vector<bool> poses;
  std::array<bool, kAngleCount> never_shown = {};
  int angle_gaps = 0;  ///< of angles that others show
};

/// Interpolates what is not observable; constant at the ends. An angle that no frame shows is 0, or kEndJointShare
/// of the middle joint. `shown`, `times_s`: per frame.
Bridged bridge_gaps(const std::vector<HandState>& states, const std::vector<Observability>& shown,
                    const std::vector<double>& times_s);

}  // namespace glovebench::trajectories
