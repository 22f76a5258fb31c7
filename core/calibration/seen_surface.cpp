#include "core/calibration/seen_surface.h"

#include <algorithm>
#include <cmath>

#include "core/pose/surface_matcher.h"

namespace glovebench::calibration {
namespace {

constexpr int kPoints = 3000;        ///< of a view
constexpr double kHeightCut_mm = 8;  ///< farther points have no weight
constexpr float kPatchCut = 0.015F;  ///< m: farther from all faces of its color a point does not count
constexpr double kSmooth = 10;       ///< points that weigh as much as one neighbor's height
constexpr double kFlat = 1;          ///< points that weigh as much as a height of 0
constexpr int kSweeps = 50;

RecycledVector<LabeledPoint> in_one_color(RecycledVector<LabeledPoint> points) {
  for (LabeledPoint& point : points) point.label = patch_labels()[0];
  return points;
}

}  // namespace

SeenSurface& SeenSurface::operator+=(const SeenSurface& other) {
  for (size_t v = 0; v < weight.size(); ++v) {
    height[v] += other.height[v];
    weight[v] += other.weight[v];
    for (int p = 0; p < kPatchCount; ++p) votes[v][p] += other.votes[v][p];
  }
  return *this;
}

SeenSurface seen_surface(const HandAndMesh& hand, const TrackedView& view, const ArticulatedPose& pose) {
  const PosedHand gloved = hand.gloved.pose(pose.posture), plain = hand.plain.pose(pose.posture);
  SurfaceMatcher colored(hand.gloved, gloved, subsample(view.seen.points, kPoints), {});
  colored.cull(pose.T_camera_hand);
  colored.match(pose.T_camera_hand);
  SurfaceMatcher any(hand.plain, plain, in_one_color(colored.cloud()), {});
  any.cull(pose.T_camera_hand);
  any.match(pose.T_camera_hand);

  SeenSurface seen(hand.plain.vertex_count());
  for (size_t i = 0; i < any.closest().size(); ++i) {
    const ClosestPoint &nearest = any.closest()[i], &in_color = colored.closest()[i];
    if (nearest.face < 0 || in_color.face < 0 || in_color.distance > kPatchCut) continue;
    const double weight = tukey_weight(1000 * static_cast<double>(nearest.distance), kHeightCut_mm);
    if (weight == 0) continue;
    const Surface::Face& face = any.surface().faces(patch_labels()[0])[nearest.face];
    const SurfacePull pull = surface_pull(face, nearest, any.points_hand()[i].p, 1);
    const Eigen::Vector3d normal = (face.b - face.a).cross(face.c - face.a).normalized().cast<double>();
    const uint32_t triangle = colored.surface().faces(colored.cloud()[i].label)[in_color.face].triangle;
    for (int corner = 0; corner < 3; ++corner) {
      const uint32_t vertex = hand.plain.triangles()[face.triangle].vertices[corner];
      const double share = std::max(0.0, pull.barycentric[corner]);
      seen.height[vertex] += share * weight * normal.dot(pull.apart_mm) / 1000;
      seen.weight[vertex] += share * weight;
      seen.votes[vertex][hand.gloved.triangles()[triangle].patch] += share;
    }
  }
  return seen;
}

std::vector<double> heights_of(const SeenSurface& seen, const HandModel& plain, std::vector<double> before) {
  before.resize(plain.vertex_count());
  std::vector<std::vector<uint32_t>> neighbors(plain.vertex_count());
  for (const Triangle& t : plain.triangles())
    for (int corner = 0; corner < 3; ++corner)
      neighbors[t.vertices[corner]].push_back(t.vertices[(corner + 1) % 3]);

  // The least sum of squares, by Gauss-Seidel.
  std::vector<double> heights = before;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (size_t v = 0; v < heights.size(); ++v) {
      double sum = seen.weight[v] * before[v] + seen.height[v], weight = seen.weight[v] + kFlat;
      for (const uint32_t neighbor : neighbors[v]) {
        sum += kSmooth * heights[neighbor];
        weight += kSmooth;
      }
      heights[v] = std::clamp(sum / weight, -kMostHeight, kMostHeight);
    }
  }
  return heights;
}

std::vector<PatchVotes> votes_of(const SeenSurface& seen) {
  std::vector<PatchVotes> votes;
  for (uint8_t patch = 0; patch < kPatchCount; ++patch)
    for (uint32_t v = 0; v < seen.votes.size(); ++v)
      if (const auto points = static_cast<int>(std::lround(seen.votes[v][patch])); points > 0)
        votes.push_back({v, patch, points});
  return votes;
}

}  // namespace glovebench::calibration
