#include "core/pose/interpolate.h"

#include "core/base/error.h"
#include "core/base/math.h"
#include "core/pose/horn.h"

namespace glovebench {
namespace {

constexpr double kAmbiguousSpread = radians_from_degrees(60);

bool spread_exceeds(std::span<const Eigen::Quaterniond> rotations, double limit) {
  for (size_t i = 0; i < rotations.size(); ++i) {
    for (size_t j = i + 1; j < rotations.size(); ++j)
      if (rotations[i].angularDistance(rotations[j]) > limit) return true;
  }
  return false;
}

}  // namespace

Eigen::Quaterniond mean_rotation(std::span<const Eigen::Quaterniond> rotations, std::span<const double> weights) {
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (size_t i = 0; i < rotations.size(); ++i) {
    const Eigen::Vector4d& q = rotations[i].coeffs();
    sum += weights[i] * q * q.transpose();
  }
  return Eigen::Quaterniond(largest_eigenvector(sum)).normalized();
}

CoarseEstimate interpolate(const Database& database, std::span<const Match> matches,
                           const std::optional<Eigen::Vector3d>& query_ray, double epsilon) {
  check(!matches.empty(), "there is a match to interpolate");
  RecycledVector<double> weights;
  RecycledVector<Eigen::Quaterniond> rotations;
  Posture posture = Posture::Zero();
  double total = 0;
  for (const Match& match : matches) {
    const double weight = 1.0 / (match.error + epsilon);
    Eigen::Quaterniond& R = rotations.emplace_back(view_rotations()[Database::view(match.entry)]);
    if (query_ray) R = Eigen::Quaterniond::FromTwoVectors(database.box_ray(match.entry), *query_ray) * R;
    weights.push_back(weight);
    posture += weight * database.posture(match.entry);
    total += weight;
  }
  CoarseEstimate estimate;
  estimate.posture = posture / total;
  estimate.R_camera_hand = mean_rotation(rotations, weights).toRotationMatrix();
  estimate.ambiguous = spread_exceeds(rotations, kAmbiguousSpread);
  return estimate;
}

}  // namespace glovebench
