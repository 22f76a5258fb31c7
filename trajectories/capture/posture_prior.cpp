#include "trajectories/capture/posture_prior.h"

#include "trajectories/generation/natural_variation.h"

namespace glovebench::trajectories {
namespace {

constexpr int kFirstAngle = kStateSize - kAngleCount;

double end_joint_excess(const Posture& posture, int pip) {
  return posture[pip + 1] - kEndJointShare * posture[pip];
}

}  // namespace

double prior_cost(const Posture& posture, const PosturePrior& prior) {
  double cost = (posture - prior.center).squaredNorm() / (prior.deviation * prior.deviation);
  for (int pip = kIndexPipFlexion; pip < kAngleCount; pip += 4) {
    const double excess = end_joint_excess(posture, pip) / prior.end_joint_deviation;
    cost += excess * excess;
  }
  return cost;
}

void add_prior(const Posture& posture, const PosturePrior& prior, Eigen::Ref<Eigen::MatrixXd> H,
               Eigen::Ref<Eigen::VectorXd> b) {
  const double weight = 1 / (prior.deviation * prior.deviation);
  H.diagonal().tail<kAngleCount>().array() += weight;
  b.tail<kAngleCount>() += weight * (prior.center - posture);
  const double joined = 1 / (prior.end_joint_deviation * prior.end_joint_deviation);
  const Eigen::Vector2d row(-kEndJointShare, 1);
  for (int pip = kIndexPipFlexion; pip < kAngleCount; pip += 4) {
    const int at = kFirstAngle + pip;
    H.block<2, 2>(at, at) += joined * row * row.transpose();
    b.segment<2>(at) -= joined * end_joint_excess(posture, pip) * row;
  }
}

}  // namespace glovebench::trajectories
