#include "core/calibration/hand_fit.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/calibration/seen_surface.h"
#include "core/calibration/size_equations.h"
#include "core/pose/surface_matcher.h"

namespace glovebench::calibration {
namespace {

/// Farther points have no weight, mm: when poses are refined (from, by way of, to), and in the equations of sizes.
struct Round {
  double wide_mm, middle_mm, narrow_mm, sizes_mm;
};
constexpr std::array<Round, 5> kRounds = {
    {{25, 16, 12, 12}, {16, 12, 8, 8}, {12, 8, 6, 6}, {12, 6, 4, 5}, {12, 6, 4, 4}}};
/// The last round repeats: sizes and heights are found in turn and settle slowly.
constexpr int kRoundCount = 28;
const Round& round_at(int round) { return kRounds[std::min<size_t>(round, kRounds.size() - 1)]; }

/// Standard deviations between people of scale, palm and segments, percent (hand_dimensions.h names sources).
constexpr double kScaleSpread = 8, kPalmSpread = 6, kLengthSpread = 6, kWidthSpread = 8;
/// The same for the joints' places in the palm, which no survey measures: wide, so that the recording decides.
constexpr double kArchSpread = 40, kThumbPlaceSpread = 20;
/// A size whose deviation stays above this share of its spread between people was not seen.
constexpr double kSeenShare = 0.5;
constexpr double kMostStep = 10;       ///< percent a round
constexpr int kResidualPoints = 3000;  ///< of a view

SizeVector spreads() {
  SizeVector spread;
  spread.segment<kSegmentCount>(kSegmentLengths).setConstant(kLengthSpread);
  spread.segment<kSegmentCount>(kSegmentWidths).setConstant(kWidthSpread);
  spread.head<kSegmentLengths>().setConstant(kPalmSpread);
  spread[kScale] = kScaleSpread;
  spread[kKnuckleArch] = kArchSpread;
  spread[kThumbPalmLength] = kThumbPlaceSpread;
  return spread;
}

/// From one side alone, a raised surface looks like a nearer hand.
bool show_both_sides(std::span<const TrackedView> views) {
  constexpr double kFacing = 0.3, kShare = 0.1;
  double palm = 0, back = 0;
  for (const TrackedView& view : views) {
    const double dorsal = view_direction(view.pose).y();
    palm += dorsal < -kFacing;
    back += dorsal > kFacing;
  }
  return std::min(palm, back) > kShare * static_cast<double>(views.size());
}

class Fit {
 public:
  Fit(std::span<const TrackedView> views, const PinholeCamera& camera, const HandMesh& mesh)
      : views_(views), camera_(camera), mesh_(mesh), finds_heights_(show_both_sides(views)) {
    for (const TrackedView& view : views) fit_.poses.push_back(view.pose);
  }

  HandFit run() {
    fit_.residual_before = Fit(views_, camera_, mesh_).residual_of_mesh();
    refine_poses(kRounds.front());
    for (int round = 0; round < kRoundCount; ++round) {
      refine_poses(round_at(round));
      step_sizes(round_at(round));
      if (round > 0) step_surface();
    }
    refine_poses(kRounds.back());
    fit_.residual = look_at_patches();
    return fit_;
  }

 private:
  /// The mean distance of the points from the mesh, with poses refined as often as `run` does, m.
  double residual_of_mesh() {
    refine_poses(kRounds.front());
    for (int round = 0; round < kRoundCount; ++round) refine_poses(round_at(round));
    refine_poses(kRounds.back());
    return look_at_patches();
  }

  HandModel hand() const { return HandModel::load(mesh_.path, mesh_.side, fit_.shape); }

  /// Calls work(v) for each view.
  template <typename Work>
  void for_each_view(const Work& work) const {
    tbb::parallel_for(size_t{0}, views_.size(), work);
  }

  void refine_poses(const Round& round) {
    FitSchedule schedule;
    schedule.trial = {1, 0, 500, {round.wide_mm, round.wide_mm}, {0.01, 0.01}, {0.2, 0.2}, true};
    schedule.rough = {3, 0, 1000, {round.wide_mm, round.middle_mm}, {0.01, 0.005}, {0.1, 0}, true};
    schedule.fine = {3, 0, 8000, {round.middle_mm, round.narrow_mm}, {0.005, 0.005}, {0, 0}, false};
    schedule.kept_starts = 1;
    schedule.bones_weight = 0;  // their widths are not known yet
    const ArticulatedFit fit(std::make_shared<const HandModel>(hand()), schedule, Implementation::fast);
    for_each_view([&](size_t v) {
      const HandView& seen = views_[v].seen;
      const ArticulatedEstimate found =
          fit({seen.points, seen.mask, camera_}, std::span(&fit_.poses[v], 1), nullptr);
      if (found.status == AlignmentStatus::converged) fit_.poses[v] = found.pose;
    });
  }

  void step_sizes(const Round& round) {
    const HandModel model = hand();
    const SurfaceMotion motion(model);
    std::vector<SizeEquations> of_views(views_.size());
    for_each_view(
        [&](size_t v) { of_views[v] = size_equations(motion, views_[v], fit_.poses[v], round.sizes_mm); });
    SizeMatrix H = SizeMatrix::Zero();
    SizeVector g = SizeVector::Zero();
    for (const SizeEquations& of_view : of_views) {
      H += of_view.H;
      g += of_view.g;
    }
    const SizeVector spread = spreads();
    for (int size = 0; size < kSizeCount; ++size) {
      const double information = 1 / (spread[size] * spread[size]);
      H(size, size) += information;
      g[size] -= information * 100 * (fit_.shape.sizes[size] - 1);
    }
    const Eigen::LDLT<SizeMatrix> solver(H);
    const SizeVector step = solver.solve(g).cwiseMax(-kMostStep).cwiseMin(kMostStep);
    const SizeMatrix covariance = solver.solve(SizeMatrix::Identity());
    for (int size = 0; size < kSizeCount; ++size) {
      double& factor = fit_.shape.sizes[size];
      factor = std::clamp(factor * (1 + step[size] / 100), kLeastHandSize, kMostHandSize);
      const double deviation = std::sqrt(std::max(0.0, covariance(size, size)));
      fit_.deviation[size] = deviation / 100;
      fit_.seen[size] = deviation < kSeenShare * spread[size];
    }
    for (size_t v = 0; v < views_.size(); ++v) fit_.poses[v] = moved(fit_.poses[v], of_views[v].step(step));
  }

  /// The surface moves to the points, and its patches to their colors.
  void step_surface() {
    const HandAndMesh both{hand(), HandModel::load_plain(mesh_.path, mesh_.side, fit_.shape)};
    std::vector<SeenSurface> of_views(views_.size(), SeenSurface(both.plain.vertex_count()));
    for_each_view([&](size_t v) { of_views[v] = seen_surface(both, views_[v], fit_.poses[v]); });
    SeenSurface seen = std::move(of_views.front());
    for (size_t v = 1; v < of_views.size(); ++v) seen += of_views[v];
    if (finds_heights_) fit_.shape.heights = heights_of(seen, both.plain, fit_.shape.heights);
    fit_.shape.patch_votes = votes_of(seen);
  }

  /// Sets what each patch's points lie off; returns the mean of all, m.
  double look_at_patches() {
    const HandModel model = hand();
    std::vector<std::array<PatchFit, kPatchCount>> of_views(views_.size());
    for_each_view([&](size_t v) {
      const PosedHand posed = model.pose(fit_.poses[v].posture);
      SurfaceMatcher matcher(model, posed, subsample(views_[v].seen.points, kResidualPoints), {});
      matcher.cull(fit_.poses[v].T_camera_hand);
      matcher.match(fit_.poses[v].T_camera_hand);
      for (size_t i = 0; i < matcher.closest().size(); ++i) {
        const ClosestPoint& closest = matcher.closest()[i];
        if (closest.face < 0) continue;
        const Surface::Face& face = matcher.surface().faces(matcher.cloud()[i].label)[closest.face];
        PatchFit& patch = of_views[v][model.triangles()[face.triangle].patch];
        ++patch.points;
        patch.residual += static_cast<double>(closest.distance);
      }
    });
    PatchFit all;
    for (int p = 0; p < kPatchCount; ++p) {
      PatchFit& patch = fit_.patches[p] = {};
      for (const auto& of_view : of_views) {
        patch.points += of_view[p].points;
        patch.residual += of_view[p].residual;
      }
      all.points += patch.points;
      all.residual += patch.residual;
      if (patch.points > 0) patch.residual /= static_cast<double>(patch.points);
    }
    check(all.points > 0, "the hand has points in its views");
    return all.residual / static_cast<double>(all.points);
  }

  std::span<const TrackedView> views_;
  const PinholeCamera& camera_;
  const HandMesh& mesh_;
  bool finds_heights_;
  HandFit fit_;
};

}  // namespace

HandFit fit_hand_shape(std::span<const TrackedView> views, const PinholeCamera& camera, const HandMesh& mesh) {
  return Fit(views, camera, mesh).run();
}

}  // namespace glovebench::calibration
