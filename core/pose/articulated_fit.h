#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/camera/pinhole_camera.h"
#include "core/pose/alignment.h"
#include "core/pose/articulated_step.h"
#include "core/pose/hand_mask.h"
#include "core/pose/pull_sums.h"

namespace glovebench {

struct HandObservation {
  std::span<const LabeledPoint> points;  ///< camera frame, m; no doubtful depths
  const HandMask& mask;
  const PinholeCamera& camera;
};

/// Gauss-Newton steps. Pairs: values of the first and last step; between them `tukey_mm` and `start_weight` change
/// geometrically, `tangential` linearly.
struct FitStage {
  int steps;                ///< >= 1
  int rigid_steps;          ///< first steps, which move only the pose
  int max_points;           ///< uniform stride
  double tukey_mm[2];       ///< farther points have no weight
  double start_weight[2];   ///< pull to the start's posture, per square degree
  double tangential[2];     ///< weight of distances along the surface, relative to the normal
  bool outline_moves_pose;  ///< false: only the angles
};
/// All starts run `trial`, the best `kept_starts` run `rough`, the best of these `fine`. Weights are for 1,000
/// points: all points together count as many.
struct FitSchedule {
  FitStage trial{3, 2, 500, {60, 29}, {0.1, 0.05}, {0.3, 0.2}, true};
  FitStage rough{6, 0, 700, {25, 12}, {0.04, 0.01}, {0.17, 0}, true};
  FitStage fine{2, 0, 8000, {12, 4}, {0.01, 0.005}, {0, 0}, false};
  int kept_starts = 2;
  double previous_weight = 0.003;  ///< pull to the previous posture, per square degree
  double outline_weight = 1;       ///< of a vertex outside the mask
  int outline_stride = 3;          ///< every nth vertex
  double bones_weight = 1;         ///< of two bones that pierce each other; a point's is 1
  double score_cut_mm = 15;        ///< cap on distances that compare starts
};

/// An angle that moves fewer points is hidden.
inline constexpr int kSeenPoints = 30;

struct ArticulatedEstimate {
  AlignmentStatus status = AlignmentStatus::too_few_points;
  ArticulatedPose pose;
  int start = -1;  ///< index into `starts`
  int points = 0;  ///< in `fine`
  int steps = 0;
  double residual = 0;                  ///< mean point-to-triangle distance before the last step, m
  std::optional<double> misfit;         ///< as TrackResult::misfit
  Posture deviation = Posture::Zero();  ///< standard, rad
  uint32_t hidden = 0;                  ///< bit a: angle a
};

/// Refines pose and posture (core/README.md, "The method `articulated`").
class ArticulatedFit {
 public:
  ArticulatedFit(std::shared_ptr<const HandModel> model, const FitSchedule& schedule,
                 Implementation implementation);

  /// `starts` is not empty. `previous`: last posture or null.
  ArticulatedEstimate operator()(const HandObservation& seen, std::span<const ArticulatedPose> starts,
                                 const Posture* previous) const;

 private:
  std::shared_ptr<const HandModel> model_;
  std::vector<BodyShares> shares_;
  std::vector<FaceBodies> faces_;
  FitSchedule schedule_;
  IcpConfig search_;
};

}  // namespace glovebench
