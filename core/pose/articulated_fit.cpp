#include "core/pose/articulated_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/pose/articulated_step.h"
#include "core/pose/surface_matcher.h"

namespace glovebench {
namespace {

constexpr double kPointsOfWeights = 1000;  ///< to which weights are normalized
/// Information of 1,000 points, per mm^2 of the equations' rows. It is chosen on generated movements so that the
/// deviations match the errors.
constexpr double kInformation = 4;
constexpr double kOutlineSlack_px = 1;  ///< a vertex on the outline may lie this far from the nearest pixel
constexpr double kStray_mm = 6;         ///< farther points are of another patch or of no hand
constexpr int kPatchPoints = 60;        ///< a patch of fewer points says little about the hand

double between(const double (&ends)[2], int step, int steps) {
  if (steps == 1) return ends[1];
  return ends[0] * std::pow(ends[1] / ends[0], static_cast<double>(step) / (steps - 1));
}
double evenly_between(const double (&ends)[2], int step, int steps) {
  if (steps == 1) return ends[1];
  return ends[0] + (ends[1] - ends[0]) * step / (steps - 1);
}

/// The weights of one step of a stage.
struct StepWeights {
  PullWeights pull;
  double start;
};

/// Fits one start to the points of a stage.
class Run {
 public:
  Run(const HandModel& model, std::span<const BodyShares> shares, std::span<const FaceBodies> faces,
      const FitSchedule& schedule, const HandObservation& seen, const IcpConfig& search, int max_points)
      : model_(model),
        shares_(shares),
        faces_(faces),
        schedule_(schedule),
        seen_(seen),
        matcher_(model, hand_, subsample(seen.points, max_points), search) {}

  /// Poses the hand, finds the closest points and the vertices outside the mask. `same_surface`: with the posture
  /// and the faces of the last call.
  void match(const ArticulatedPose& pose, bool same_surface) {
    if (!same_surface) {
      hand_ = model_.pose(pose.posture);
      matcher_.cull(pose.T_camera_hand);
    }
    matcher_.match(pose.T_camera_hand);
    find_outside(pose.T_camera_hand);
  }

  /// The normal equations of points and outline at the pose that was matched.
  NormalEquations equations(const StepWeights& weights, bool outline_moves_pose) {
    const std::array<Screw, kAngleCount> screws = angle_screws(model_, hand_);
    PullSums of_points(screws), of_outline(screws);
    of_points.add({matcher_.points_hand(), matcher_.closest(), matcher_.surface()}, faces_, weights.pull);
    for (const Outside& outside : outside_) of_outline.add(outside.pull, shares_[outside.vertex]);
    NormalEquations sum = of_points.equations(), outline = of_outline.equations();
    const double scale = kPointsOfWeights / std::max(1, points());
    if (!outline_moves_pose) {
      outline.H.topRows<6>().setZero();
      outline.H.leftCols<6>().setZero();
      outline.g.head<6>().setZero();
    }
    sum.H *= scale;
    H_points_ = sum.H;
    sum.H += outline.H;
    sum.g = scale * sum.g + outline.g;
    for (const BonePair& pair : overlapping_bones(hand_.T_hand_joint, kBonesMayOverlap))
      push_apart(sum, screws, pair, schedule_.bones_weight);
    return sum;
  }

  /// Standard deviation of each angle, rad, from the points of the last equations.
  Posture deviation() const {
    StepMatrix information = kInformation * H_points_;
    for (int a = 0; a < kAngleCount; ++a) {
      // Without points an angle may lie anywhere between its limits: the variance of an even distribution.
      const double range_deg = angle_infos()[a].max_deg - angle_infos()[a].min_deg;
      information(6 + a, 6 + a) += 12 / (range_deg * range_deg);
    }
    const StepMatrix covariance = information.ldlt().solve(StepMatrix::Identity());
    Posture result;
    for (int a = 0; a < kAngleCount; ++a)
      result[a] = radians_from_degrees(std::sqrt(std::max(0.0, covariance(6 + a, 6 + a))));
    return result;
  }
  /// The points whose closest face is of a patch.
  struct PatchPoints {
    int all = 0;
    int near = 0;           ///< within kStray_mm
    double height_sum = 0;  ///< signed distances of the near ones from the surface, positive outside, mm
  };
  std::array<PatchPoints, kPatchCount> points_of_patches() const {
    std::array<PatchPoints, kPatchCount> patches;
    for (size_t i = 0; i < matcher_.closest().size(); ++i) {
      const ClosestPoint& closest = matcher_.closest()[i];
      if (closest.face < 0) continue;
      const Surface::Face& face = matcher_.surface().faces(matcher_.cloud()[i].label)[closest.face];
      PatchPoints& patch = patches[model_.triangles()[face.triangle].patch];
      ++patch.all;
      const double distance_mm = 1000 * static_cast<double>(closest.distance);
      if (distance_mm > kStray_mm) continue;
      ++patch.near;
      const Eigen::Vector3f normal = (face.b - face.a).cross(face.c - face.a);
      const bool is_outside = normal.dot(matcher_.points_hand()[i].p - closest.p_hand) > 0;
      patch.height_sum += is_outside ? distance_mm : -distance_mm;
    }
    return patches;
  }
  /// RMS of the patches' mean heights over the surface, m: noise averages out of them, a wrong size does not.
  static std::optional<double> misfit(const std::array<PatchPoints, kPatchCount>& patches) {
    double squares = 0;
    int count = 0;
    for (const PatchPoints& patch : patches) {
      if (patch.near < kPatchPoints) continue;
      squares += patch.height_sum * patch.height_sum / patch.near;
      count += patch.near;
    }
    if (count == 0) return {};
    return std::sqrt(squares / count) / 1000;
  }
  /// The angles that move few of the points, as bits.
  uint32_t hidden(const std::array<PatchPoints, kPatchCount>& patches) const {
    const size_t stride = (seen_.points.size() + points() - 1) / points();
    uint32_t hidden = 0;
    for (int a = 0; a < kAngleCount; ++a) {
      size_t moved_points = 0;
      for (int patch = 0; patch < kPatchCount; ++patch)
        if (patches_moved()[a] >> patch & 1) moved_points += patches[patch].all * stride;
      if (moved_points < kSeenPoints) hidden |= uint32_t{1} << a;
    }
    return hidden;
  }

  int points() const { return static_cast<int>(matcher_.closest().size()); }
  int matched_points() const {
    return static_cast<int>(std::ranges::count_if(matcher_.closest(), [](auto& c) { return c.face >= 0; }));
  }
  double mean_distance() const {
    double sum = 0;
    for (const ClosestPoint& closest : matcher_.closest()) sum += closest.distance;
    return sum / std::max(1, matched_points());
  }

  /// The cost of the matched pose: mean squared truncated distances of points, and of vertices to the mask, mm^2.
  double score() const {
    const auto cost = [&](double distance_mm) {
      const double cut = std::min(distance_mm, schedule_.score_cut_mm);
      return cut * cut;
    };
    double of_points = 0, of_outline = 0;
    for (const ClosestPoint& closest : matcher_.closest())
      of_points += cost(closest.face < 0 ? schedule_.score_cut_mm : 1000 * static_cast<double>(closest.distance));
    for (const Outside& outside : outside_) of_outline += cost(outside.pull.distance_mm);
    const double vertices = static_cast<double>(hand_.vertices.size()) / schedule_.outline_stride;
    return of_points / std::max(1, points()) + of_outline / vertices;
  }

 private:
  /// A vertex that is seen outside the mask, and the way back.
  struct Outside {
    size_t vertex;
    Pull pull;
  };
  void find_outside(const Eigen::Isometry3d& T_camera_hand) {
    outside_.clear();
    const PinholeCamera& camera = seen_.camera;
    for (size_t vertex = 0; vertex < hand_.vertices.size(); vertex += schedule_.outline_stride) {
      const Eigen::Vector3d q = hand_.vertices[vertex].cast<double>(), p = T_camera_hand * q;
      if (!(p.z() > 0.1)) continue;
      const Eigen::Vector2d uv = camera.project(p);
      if (!(uv.x() >= 0 && uv.y() >= 0 && uv.x() <= camera.width - 1 && uv.y() <= camera.height - 1)) continue;
      const std::optional<Eigen::Vector2d> way = seen_.mask.way_back_px(uv);
      if (!way) continue;
      const double slope = way->x() * p.x() / p.z() + way->y() * p.y() / p.z();
      const Eigen::Vector3d direction = Eigen::Vector3d(way->x(), way->y(), -slope).normalized();
      outside_.push_back({vertex,
                          {q, T_camera_hand.linear().transpose() * direction,
                           1000 * (way->norm() - kOutlineSlack_px) * p.z() / camera.fx, schedule_.outline_weight}});
    }
  }

  const HandModel& model_;
  std::span<const BodyShares> shares_;
  std::span<const FaceBodies> faces_;
  const FitSchedule& schedule_;
  const HandObservation& seen_;
  PosedHand hand_;
  SurfaceMatcher matcher_;
  RecycledVector<Outside> outside_;
  StepMatrix H_points_ = StepMatrix::Zero();
};

/// Adds a prior that draws the posture to `held`.
void hold(NormalEquations& equations, const Posture& posture, const Posture& held, double weight) {
  for (int a = 0; a < kAngleCount; ++a) equations.hold(a, degrees_from_radians(held[a] - posture[a]), weight);
}

}  // namespace

ArticulatedFit::ArticulatedFit(std::shared_ptr<const HandModel> model, const FitSchedule& schedule,
                               Implementation implementation)
    : model_(std::move(model)),
      shares_(body_shares(*model_)),
      faces_(face_bodies(*model_, shares_)),
      schedule_(schedule) {
  search_.implementation = implementation;
}

ArticulatedEstimate ArticulatedFit::operator()(const HandObservation& seen, std::span<const ArticulatedPose> starts,
                                               const Posture* previous) const {
  ArticulatedEstimate best;
  if (seen.points.size() < 3) return best;

  struct Candidate {
    int start;
    ArticulatedPose pose;
    double score = 0;  ///< before its last step
  };
  // Takes the steps of a stage. Returns `converged` or the reason why not.
  const auto run_stage = [&](Run& run, const FitStage& stage, Candidate& candidate) {
    ArticulatedPose& pose = candidate.pose;
    for (int i = 0; i < stage.steps; ++i) {
      run.match(pose, i > 0 && i < stage.rigid_steps);
      if (run.matched_points() < 3) return AlignmentStatus::no_shared_color;
      if (i + 1 == stage.steps) candidate.score = run.score();
      const StepWeights weights{
          {between(stage.tukey_mm, i, stage.steps), evenly_between(stage.tangential, i, stage.steps)},
          between(stage.start_weight, i, stage.steps)};
      NormalEquations equations = run.equations(weights, stage.outline_moves_pose);
      hold(equations, pose.posture, starts[candidate.start].posture, weights.start);
      if (previous != nullptr) hold(equations, pose.posture, *previous, schedule_.previous_weight);
      const auto step = solve_within_limits(equations, pose.posture, i < stage.rigid_steps);
      if (!step) return AlignmentStatus::degenerate_cloud;
      pose = moved(pose, *step);
    }
    return AlignmentStatus::converged;
  };
  // The candidates that complete a stage, best first, at most `most`.
  const auto best_of = [&](const FitStage& stage, const RecycledVector<Candidate>& from, int most) {
    Run run(*model_, shares_, faces_, schedule_, seen, search_, stage.max_points);
    RecycledVector<Candidate> to;
    for (Candidate candidate : from) {
      best.status = run_stage(run, stage, candidate);
      if (best.status == AlignmentStatus::converged) to.push_back(candidate);
    }
    std::ranges::sort(to, {}, [](const Candidate& c) { return std::pair(c.score, c.start); });
    if (static_cast<int>(to.size()) > most) to.resize(most, to.front());
    return to;
  };

  RecycledVector<Candidate> candidates;
  for (int s = 0; s < static_cast<int>(starts.size()); ++s) candidates.push_back({s, starts[s]});
  candidates = best_of(schedule_.trial, candidates, schedule_.kept_starts);
  candidates = best_of(schedule_.rough, candidates, 1);
  if (candidates.empty()) return best;

  Run fine(*model_, shares_, faces_, schedule_, seen, search_, schedule_.fine.max_points);
  best.status = run_stage(fine, schedule_.fine, candidates.front());
  if (best.status != AlignmentStatus::converged) return best;
  best.start = candidates.front().start;
  best.pose = candidates.front().pose;
  best.points = fine.points();
  best.steps = schedule_.trial.steps + schedule_.rough.steps + schedule_.fine.steps;
  best.residual = fine.mean_distance();
  best.deviation = fine.deviation();
  const auto patches = fine.points_of_patches();
  best.misfit = fine.misfit(patches);
  best.hidden = fine.hidden(patches);
  return best;
}

}  // namespace glovebench
