#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "core/hand/hand_motion.h"

namespace glovebench {

/// A hand in space.
struct ArticulatedPose {
  Posture posture = Posture::Zero();
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();
};

/// The unknowns of a Gauss-Newton step: turn of the hand about its origin (degrees, hand frame), shift (mm, hand
/// frame), the 22 angles (degrees). In these units all are of one size.
inline constexpr int kUnknowns = 6 + kAngleCount;
using StepVector = Eigen::Matrix<double, kUnknowns, 1>;
using StepMatrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// A distance that a point of the surface should go along a direction.
struct Pull {
  Eigen::Vector3d q;          ///< the point, hand frame, m
  Eigen::Vector3d direction;  ///< hand frame
  double distance_mm = 0;
  double weight = 1;
};
/// How far the pull's point moves along its direction as a rigid body turns (a degree) and shifts (a millimeter).
Vector6d row_of(const Pull& pull);

/// Normal equations H step = g of weighted pulls.
struct NormalEquations {
  StepMatrix H = StepMatrix::Zero();
  StepVector g = StepVector::Zero();

  /// Draws an angle to a value that is `away_deg` from where it is; `weight`: per square degree.
  void hold(int angle, double away_deg, double weight);
};

/// The equations as they are written: a row of the Jacobian for each pull, `row_of` it for the hand, and for each
/// angle its share of what its screw moves.
class PlainPullSums {
 public:
  explicit PlainPullSums(const std::array<Screw, kAngleCount>& screws) : screws_(screws) {}
  /// `shares`: of the bodies in the point.
  void add(const Pull& pull, const BodyShares& shares);
  NormalEquations equations() const { return equations_; }

 private:
  std::array<Screw, kAngleCount> screws_;
  NormalEquations equations_;
};

/// The bodies that a point hangs on, and their shares.
struct BodyList {
  int count = 0;
  std::array<uint8_t, 12> body{};
  std::array<double, 12> share{};
};

/// Sums over pulls at one point: of products of their rows, and of the rows times their distances.
struct RowSums {
  Eigen::Matrix<double, 21, 1> products = Eigen::Matrix<double, 21, 1>::Zero();  ///< upper triangle, row by row
  Vector6d sum = Vector6d::Zero();

  void add(const Pull& pull);
  /// Three pulls, one along each axis: the point should go by `apart_mm`.
  void add_along_axes(const Eigen::Vector3d& q, const Eigen::Vector3d& apart_mm, double weight);
};

/// The same sums, faster: a point moves by the sum of what its bodies do, so its row is a sum over its bodies of
/// share x (what the body's angles make of a row of 6). For each two bodies that share points, 6 x 6 numbers are
/// summed up; the angles come in at the end.
class PullSums {
 public:
  explicit PullSums(const std::array<Screw, kAngleCount>& screws);
  void add(const RowSums& pulls_at_point, const BodyList& bodies);
  NormalEquations equations() const;

 private:
  static constexpr int kPairs = kBodyCount * (kBodyCount + 1) / 2;
  struct Pair {
    Eigen::Matrix<double, 21, 1> products =
        Eigen::Matrix<double, 21, 1>::Zero();  ///< lower triangle, column by column
    bool is_used = false;
  };

  std::array<Vector6d, kAngleCount> screws_;  ///< as `row_of` counts
  std::array<Pair, kPairs> pairs_;
  std::array<Vector6d, kBodyCount> sums_;
};

/// The solution of H step = g that moves no angle beyond its limits: an angle whose step would cross a limit ends
/// there, and the others are solved for again (active set). `only_pose` keeps all angles where they are. Empty if
/// the equations leave a motion open.
std::optional<StepVector> solve_within_limits(const NormalEquations& equations, const Posture& posture,
                                              bool only_pose = false);

/// The hand after a step.
ArticulatedPose moved(const ArticulatedPose& pose, const StepVector& step);

}  // namespace glovebench
