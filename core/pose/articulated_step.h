#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "core/base/math.h"
#include "core/hand/hand_model.h"
#include "core/hand/solid_bones.h"
#include "core/pose/closest_point.h"

namespace glovebench {

struct ArticulatedPose {
  Posture posture = Posture::Zero();
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();
};

/// Hand frame: rotation about the origin (degrees), translation (mm), angles (degrees).
inline constexpr int kUnknowns = 6 + kAngleCount;
using StepVector = Eigen::Matrix<double, kUnknowns, 1>;
using StepMatrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// How far a surface point should move, along a direction.
struct Pull {
  Eigen::Vector3d q;          ///< hand frame, m
  Eigen::Vector3d direction;  ///< hand frame
  double distance_mm = 0;
  double weight = 1;
};
/// Motion along the pull, per degree of rotation and mm of translation.
Vector6d row_of(const Pull& pull);
/// A screw as it acts on rows: row . result is the motion along the pull, mm per degree.
Vector6d on_rows(const Screw& screw);

/// 1 at 0, 0 from `width` on.
double tukey_weight(double distance, double width);

inline constexpr double kMmPerDegree = radians_from_degrees(1000.0);  ///< at 1 m from the axis
inline constexpr double kInsideFace = 1e-3;   ///< barycentric coordinates above it: not on an edge
inline constexpr double kNoDirection = 1e-5;  ///< m: nearer points have no direction

struct SurfacePull {
  Pull pull;                 ///< along the normal inside a face, else along the connection
  Eigen::Vector3d apart_mm;  ///< from surface to point, hand frame
  Eigen::Vector3d barycentric;
};
SurfacePull surface_pull(const Surface::Face& face, const ClosestPoint& closest, const Eigen::Vector3f& p_hand,
                         double weight);

/// Points and what is nearest to each of them on a surface. Hand frame.
struct MatchedPoints {
  std::span<const LabeledPoint> points;
  std::span<const ClosestPoint> closest;
  const Surface& surface;
};

/// Weights of pulls on matched points.
struct PullWeights {
  double tukey_mm;    ///< distance from which a point has no weight
  double tangential;  ///< share of a point's weight that counts along each axis instead of along its pull
};

/// H step = g.
struct NormalEquations {
  StepMatrix H = StepMatrix::Zero();
  StepVector g = StepVector::Zero();

  /// Pulls an angle by `away_deg`. `weight`: per square degree.
  void hold(int angle, double away_deg, double weight);
};

/// By how much capsules may overlap, m. Flesh gives way; the thumb's tip presses on fingers, and its pad is thinner
/// than its capsule.
inline constexpr double kBonesMayOverlap = 0.002, kThumbMayOverlap = 0.006;
double may_overlap(const BonePair& pair);
/// If bones overlap by more, adds a row: the angles move them apart along their nearest points. The hand's pose
/// does not.
void push_apart(NormalEquations& equations, const std::array<Screw, kAngleCount>& screws, const BonePair& pair,
                double weight);

/// One Jacobian row per pull.
class PlainPullSums {
 public:
  explicit PlainPullSums(const std::array<Screw, kAngleCount>& screws) : screws_(screws) {}
  /// `shares`: the point's.
  void add(const Pull& pull, const BodyShares& shares);
  /// Adds `surface_pull` of each point, and pulls along the axes. `shares`: of all vertices.
  void add(const MatchedPoints& matched, std::span<const Triangle> triangles, std::span<const BodyShares> shares,
           const PullWeights& weights);
  NormalEquations equations() const { return equations_; }

 private:
  std::array<Screw, kAngleCount> screws_;
  NormalEquations equations_;
};

/// Solves H step = g within joint limits (active set). `only_pose` fixes the angles. Empty if a motion is
/// undetermined.
std::optional<StepVector> solve_within_limits(const NormalEquations& equations, const Posture& posture,
                                              bool only_pose = false);

ArticulatedPose moved(const ArticulatedPose& pose, const StepVector& step);

}  // namespace glovebench
