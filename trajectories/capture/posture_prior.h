#pragma once

#include "core/base/angles.h"
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

}  // namespace glovebench::trajectories
