#include "eval/true_neighbor.h"

#include <limits>

#include "core/base/error.h"

namespace glovebench::eval {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// Smallest rotation from a ray to the optical axis.
Matrix3d R_axis_ray(const Vector3d& ray) {
  return Eigen::Quaterniond::FromTwoVectors(ray, Vector3d::UnitZ()).toRotationMatrix();
}

/// Ray through the middle of the square around the projections.
Vector3d box_ray(const Matrix3Xd& vertices_camera, const PinholeCamera& camera) {
  check(vertices_camera.row(2).minCoeff() > 0, "the true hand lies in front of the camera");
  Eigen::AlignedBox2d box;
  for (const auto& p_camera : vertices_camera.colwise()) box.extend(camera.project(p_camera));
  const Eigen::Vector2d middle_px = box.center();
  return camera.back_project(middle_px.x(), middle_px.y(), 1.0).normalized();
}

/// Weighted mean distance between the points of `a` and R times those of `b`. May stop early with any value above
/// `limit`.
double mean_distance(const Matrix3Xd& a, const Matrix3Xd& b, const Matrix3d& R, const Eigen::VectorXd& weights,
                     double limit) {
  double sum = 0;
  for (Eigen::Index i = 0; i < a.cols() && sum <= limit; ++i) sum += weights[i] * (a.col(i) - R * b.col(i)).norm();
  return sum;
}

}  // namespace

TrueNeighborSearch::TrueNeighborSearch(const HandModel& model, const Database& database)
    : model_(model), patch_of_vertex_(model.vertex_count()) {
  check(model.side() == database.side(), "the true hand is of the database's side");
  const auto count = static_cast<double>(model.vertex_count());
  vertex_weights_ = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(model.vertex_count()), 1 / count);
  // A vertex on a border counts for one of its patches.
  for (const Triangle& triangle : model.triangles())
    for (const uint32_t vertex : triangle.vertices) patch_of_vertex_[vertex] = triangle.patch;
  patch_weights_ = Eigen::VectorXd::Zero(kPatchCount);
  for (const int patch : patch_of_vertex_) patch_weights_[patch] += 1 / count;

  for (const Posture& posture : database.posture_set().postures) {
    const PosedHand hand = model.pose(posture);
    Matrix3Xd& vertices = vertices_hand_.emplace_back(3, static_cast<Eigen::Index>(hand.vertices.size()));
    for (size_t v = 0; v < hand.vertices.size(); ++v)
      vertices.col(static_cast<Eigen::Index>(v)) = hand.vertices[v].cast<double>();
    centers_hand_.push_back(patch_centers(vertices));
  }
  for (int entry = 0; entry < database.entry_count(); ++entry)
    R_ray_hand_.push_back(R_axis_ray(database.box_ray(entry)) * view_rotations()[Database::view(entry)]);
}

Matrix3Xd TrueNeighborSearch::patch_centers(const Matrix3Xd& vertices) const {
  Matrix3Xd centers = Matrix3Xd::Zero(3, kPatchCount);
  for (Eigen::Index v = 0; v < vertices.cols(); ++v) {
    const int patch = patch_of_vertex_[static_cast<size_t>(v)];
    centers.col(patch) += vertex_weights_[v] / patch_weights_[patch] * vertices.col(v);
  }
  return centers;
}

Matrix3Xd TrueNeighborSearch::seen_along_ray(const Posture& posture, const Eigen::Isometry3d& T_camera_hand,
                                             const PinholeCamera& camera) const {
  const PosedHand hand = model_.pose(posture);
  Matrix3Xd turned(
      3, static_cast<Eigen::Index>(hand.vertices.size()));  // in the camera's orientation, origin at the hand's
  for (size_t v = 0; v < hand.vertices.size(); ++v)
    turned.col(static_cast<Eigen::Index>(v)) = T_camera_hand.linear() * hand.vertices[v].cast<double>();
  const Matrix3Xd vertices_camera = turned.colwise() + T_camera_hand.translation();
  return R_axis_ray(box_ray(vertices_camera, camera)) * turned;
}

TrueNeighbor TrueNeighborSearch::nearest_plain(const Posture& posture, const Eigen::Isometry3d& T_camera_hand,
                                               const PinholeCamera& camera) const {
  const Matrix3Xd query = seen_along_ray(posture, T_camera_hand, camera);
  TrueNeighbor best{-1, kNoLimit};
  for (int entry = 0; entry < static_cast<int>(R_ray_hand_.size()); ++entry) {
    const double distance =
        mean_distance(query, vertices_hand_[posture_of(entry)], R_ray_hand_[entry], vertex_weights_, kNoLimit);
    if (distance < best.distance) best = {entry, distance};
  }
  return best;
}

TrueNeighbor TrueNeighborSearch::nearest(const Posture& posture, const Eigen::Isometry3d& T_camera_hand,
                                         const PinholeCamera& camera) const {
  const Matrix3Xd query = seen_along_ray(posture, T_camera_hand, camera);
  const Matrix3Xd centers = patch_centers(query);
  // Lower bound: a patch's mean vertex distance is at least the distance of its centroids.
  std::vector<double> bounds(R_ray_hand_.size());
  for (size_t entry = 0; entry < bounds.size(); ++entry) {
    bounds[entry] = mean_distance(centers, centers_hand_[posture_of(static_cast<int>(entry))], R_ray_hand_[entry],
                                  patch_weights_, kNoLimit);
  }
  const auto distance_of = [&](int entry, double limit) {
    return mean_distance(query, vertices_hand_[posture_of(entry)], R_ray_hand_[entry], vertex_weights_, limit);
  };
  // The most promising entry first, since it rules out nearly all others.
  const int promising = static_cast<int>(std::ranges::min_element(bounds) - bounds.begin());
  TrueNeighbor best{promising, distance_of(promising, kNoLimit)};
  constexpr double kRounding = 1e-9;  // m; larger than the rounding of sums under 1 m
  for (int entry = 0; entry < static_cast<int>(bounds.size()); ++entry) {
    if (bounds[entry] > best.distance + kRounding) continue;
    const double distance = distance_of(entry, best.distance);
    if (distance < best.distance || (distance == best.distance && entry < best.entry)) best = {entry, distance};
  }
  return best;
}

}  // namespace glovebench::eval
