#pragma once

#include <vector>

#include "core/base/math.h"
#include "trajectories/capture/capture_hand.h"

namespace glovebench::trajectories {

/// What is known of a posture before any point is seen.
struct PosturePrior {
  Posture center = Posture::Zero();  ///< where it stays if no point shows it, rad
  double deviation = radians_from_degrees(60);
  /// How far an end joint may be from kEndJointShare of its middle joint, rad: one tendon bends both, which the
  /// markers of a finger's last segment alone cannot tell well from a marker that sits elsewhere.
  double end_joint_deviation = radians_from_degrees(15);
};

/// Squares of deviations.
double prior_cost(const Posture& posture, const PosturePrior& prior);
/// Adds the prior to the normal equations of a state.
void add_prior(const Posture& posture, const PosturePrior& prior, Eigen::Ref<Eigen::MatrixXd> H,
               Eigen::Ref<Eigen::VectorXd> b);

/// The deviation of a point that counts as one, m: what costs are measured in.
inline constexpr double kPointDeviation = 0.001;

struct FrameFitOptions {
  /// Points farther off than this count less and less (Cauchy's weights), m.
  double robust_scale = 0.003;
  int max_iterations = 40;
};

/// What a state leaves of the points of one frame.
struct WeightedResiduals {
  Eigen::VectorXd residuals;  ///< three for each marker, of kPointDeviation, times the root of its weight; 0 unseen
  Eigen::VectorXd row_scale;  ///< takes a Jacobian's rows (m) to those of `residuals`; 0 unseen
  double cost = 0;
};
/// `points`: one for each marker, or a gap.
WeightedResiduals weighted_residuals(const CaptureHand& hand, const std::vector<Eigen::Vector3d>& points,
                                     const HandState& state, double robust_scale);

/// Takes out of the system H step = b the angles at a limit beyond which the step would lead: they stay.
void hold_at_limits(const HandState& state, Eigen::Ref<Eigen::MatrixXd> H, Eigen::Ref<Eigen::VectorXd> b);

struct FrameFit {
  HandState state;
  double cost = 0;
};

/// The state whose markers lie nearest to the points: damped Gauss-Newton from `start` over pose and angles, robust
/// weights, within the joint limits, with the PosturePrior about the start.
FrameFit fit_frame(const CaptureHand& hand, const std::vector<Eigen::Vector3d>& points, const HandState& start,
                   const FrameFitOptions& options = {});

/// The distance of each point from its marker, m; NaN of a gap.
std::vector<double> point_distances(const CaptureHand& hand, const std::vector<Eigen::Vector3d>& points,
                                    const HandState& state);

/// How well the points of a frame show a state.
struct Observability {
  bool pose = false;
  std::array<bool, kAngleCount> angles = {};
};
/// An angle is shown if points that are kPointDeviation off leave it within kShownDeviation.
inline constexpr double kShownDeviation = radians_from_degrees(15);
Observability observability(const CaptureHand& hand, const std::vector<Eigen::Vector3d>& points,
                            const HandState& state, double robust_scale);

}  // namespace glovebench::trajectories
