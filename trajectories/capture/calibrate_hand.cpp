#include "trajectories/capture/calibrate_hand.h"

#include <Eigen/Cholesky>

#include "trajectories/capture/fit_frame.h"

namespace glovebench::trajectories {
namespace {

constexpr int kMaxIterations = 40;
constexpr double kFirstCalibrationDamping = 1e-3, kMostCalibrationDamping = 1e6;
constexpr double kConstraintDeviation = 1e-5;  ///< m: as good as none
/// What the points show badly stays about where the model's own hand put it; weak beside what they show well.
constexpr double kPostureDeviation = radians_from_degrees(80);

using StateMatrix = Eigen::Matrix<double, kStateSize, kStateSize>;
using PointsOfFrames = std::vector<std::vector<Eigen::Vector3d>>;

/// One guess of everything.
struct Guess {
  Eigen::VectorXd parameters;
  std::vector<HandState> states;
};

/// The normal equations of one frame.
struct FrameBlock {
  StateMatrix H;
  StateStep b;
  Eigen::MatrixXd cross;  ///< states by parameters
};

struct System {
  std::vector<FrameBlock> frames;
  Eigen::MatrixXd H;  ///< of the parameters
  Eigen::VectorXd b;
};

class Problem {
 public:
  Problem(const HandParameters& parameters, const PointsOfFrames& points, const std::vector<HandState>& start,
          double scale)
      : parameters_(parameters), points_(points), start_(start), robust_scale_(scale) {}

  double cost(const Guess& guess) const {
    const CaptureHand hand = parameters_.hand(guess.parameters);
    double sum = guess.parameters.cwiseQuotient(parameters_.deviations()).squaredNorm() +
                 (parameters_.frame_constraints() * guess.parameters).squaredNorm() /
                     (kConstraintDeviation * kConstraintDeviation);
    for (size_t f = 0; f < points_.size(); ++f) {
      sum += weighted_residuals(hand, points_[f], guess.states[f], robust_scale_).cost +
             prior_cost(guess.states[f].posture, prior_of(f));
    }
    return sum;
  }

  System linearize(const Guess& guess) const {
    const CaptureHand hand = parameters_.hand(guess.parameters);
    System system;
    const Eigen::VectorXd prior = parameters_.deviations().cwiseAbs2().cwiseInverse();
    const Eigen::MatrixXd constraints = parameters_.frame_constraints() / kConstraintDeviation;
    system.H = constraints.transpose() * constraints;
    system.H.diagonal() += prior;
    system.b = -system.H * guess.parameters;
    for (size_t f = 0; f < points_.size(); ++f) {
      const HandState& state = guess.states[f];
      const WeightedResiduals weighted = weighted_residuals(hand, points_[f], state, robust_scale_);
      const Eigen::MatrixXd J = weighted.row_scale.asDiagonal() * state_jacobian(hand, state);
      const Eigen::MatrixXd G = weighted.row_scale.asDiagonal() * parameters_.jacobian(hand, state);
      system.H += G.transpose() * G;
      system.b += G.transpose() * weighted.residuals;
      system.frames.push_back(block(state, prior_of(f), weighted, J, G));
    }
    return system;
  }

 private:
  PosturePrior prior_of(size_t frame) const {
    return {.center = start_[frame].posture, .deviation = kPostureDeviation};
  }

  static FrameBlock block(const HandState& state, const PosturePrior& prior, const WeightedResiduals& weighted,
                          const Eigen::MatrixXd& J, const Eigen::MatrixXd& G) {
    FrameBlock frame{J.transpose() * J, J.transpose() * weighted.residuals, J.transpose() * G};
    add_prior(state.posture, prior, frame.H, frame.b);
    const StateStep wanted = frame.b;
    hold_at_limits(state, frame.H, frame.b);
    for (int i = 0; i < kStateSize; ++i)
      if (frame.b[i] == 0 && wanted[i] != 0) frame.cross.row(i).setZero();
    return frame;
  }

  const HandParameters& parameters_;
  const PointsOfFrames& points_;
  const std::vector<HandState>& start_;
  double robust_scale_;
};

/// The guess after one damped step: the states are eliminated (Schur complement), then found again.
Guess stepped(const Guess& guess, const System& system, double damping) {
  Eigen::MatrixXd H = system.H;
  H.diagonal() *= 1 + damping;
  Eigen::VectorXd b = system.b;
  std::vector<Eigen::LLT<StateMatrix>> factors;
  std::vector<Eigen::MatrixXd> solved;
  for (const FrameBlock& frame : system.frames) {
    StateMatrix damped = frame.H;
    damped.diagonal().array() *= 1 + damping;
    damped.diagonal().array() += 1e-6;
    factors.emplace_back(damped);
    solved.emplace_back(factors.back().solve(frame.cross));
    H.noalias() -= frame.cross.transpose() * solved.back();
    b -= solved.back().transpose() * frame.b;
  }
  const Eigen::VectorXd step = H.ldlt().solve(b);
  Guess next = guess;
  next.parameters += step;
  for (size_t f = 0; f < system.frames.size(); ++f) {
    const StateStep state_step = factors[f].solve(system.frames[f].b) - solved[f] * step;
    next.states[f] = moved(guess.states[f], state_step);
  }
  return next;
}

}  // namespace

Calibration calibrate_hand(const CaptureHand& start, const PointsOfFrames& points,
                           const std::vector<HandState>& states, double robust_scale, double smallest_gain) {
  const HandParameters parameters(start);
  const Problem problem(parameters, points, states, robust_scale);
  Guess guess{Eigen::VectorXd::Zero(parameters.size()), states};
  double cost = problem.cost(guess);
  double damping = kFirstCalibrationDamping;
  for (int i = 0; i < kMaxIterations; ++i) {
    const System system = problem.linearize(guess);
    double gain = 0;
    while (gain <= 0 && damping < kMostCalibrationDamping) {
      Guess next = stepped(guess, system, damping);
      const double next_cost = problem.cost(next);
      gain = std::isfinite(next_cost) ? cost - next_cost : 0;
      damping = gain > 0 ? std::max(1e-9, damping / 10) : damping * 10;
      if (gain <= 0) continue;
      guess = std::move(next);
      cost = next_cost;
    }
    if (gain <= smallest_gain * cost) break;
  }
  return {parameters.hand(guess.parameters), guess.states};
}

}  // namespace glovebench::trajectories
