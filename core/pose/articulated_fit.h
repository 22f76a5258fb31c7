#pragma once

#include <memory>
#include <span>

#include "core/camera/pinhole_camera.h"
#include "core/pose/articulated_step.h"
#include "core/pose/hand_mask.h"
#include "core/pose/icp.h"

namespace glovebench {

/// The hand in one frame.
struct HandObservation {
  std::span<const LabeledPoint> points;  ///< camera frame, m; without those whose depth is doubtful
  const HandMask& mask;
  const PinholeCamera& camera;
};

/// Gauss-Newton steps of one kind. What has two values goes from the first to the second: widths and weights in
/// equal ratios, the share in equal steps.
struct FitStage {
  int steps;                ///< >= 1
  int rigid_steps;          ///< the first ones move the pose alone
  int max_points;           ///< uniform stride down to at most this many
  double tukey_mm[2];       ///< farther points have no weight
  double start_weight[2];   ///< holds the posture of the start, per square degree
  double tangential[2];     ///< what of a point's distance lies along the surface counts this share
  bool outline_moves_pose;  ///< and not the angles alone
};
/// The stages of the fit: each start runs the trial, the best of them the rough stage, the best of those the fine
/// one. The weights of points are those of 1,000 points, however many there are.
struct FitSchedule {
  FitStage trial{4, 2, 500, {60, 29}, {0.1, 0.05}, {0.3, 0.2}, true};
  FitStage rough{6, 0, 1000, {25, 12}, {0.04, 0.01}, {0.17, 0}, true};
  FitStage fine{3, 0, 8000, {12, 4}, {0.01, 0.005}, {0, 0}, false};
  int kept_starts = 2;             ///< that run the rough stage
  double previous_weight = 0.003;  ///< holds the previous posture, per square degree
  double outline_weight = 1;       ///< of a vertex that is seen outside the mask
  int outline_stride = 3;          ///< every n-th vertex
  double score_cut_mm = 15;        ///< a distance counts as at most this when starts are compared
};

/// An angle that moves fewer points than this is hidden.
inline constexpr int kSeenPoints = 30;

struct ArticulatedEstimate {
  AlignmentStatus status = AlignmentStatus::too_few_points;
  ArticulatedPose pose;
  int start = -1;                       ///< which one it came from
  int points = 0;                       ///< of the fine stage
  int steps = 0;                        ///< of one start
  double residual = 0;                  ///< mean point-to-triangle distance before the last step, m
  Posture deviation = Posture::Zero();  ///< standard deviation of each angle, rad
  uint32_t hidden = 0;                  ///< bit a: fewer than kSeenPoints points lie on what angle a moves
};

/// The bodies that the corners of a face hang on, and their shares in each corner.
struct FaceBodies {
  static constexpr int kMost = 8;
  int count = 0;
  std::array<uint8_t, kMost> body{};
  std::array<std::array<float, kMost>, 3> share{};
};

/// Refines pose and posture against the points of a frame: iterative closest points of the points' colors on the
/// posed surface, point to plane where the closest point lies inside a face and along the connecting line
/// elsewhere, under Tukey weights that narrow, a prior that fades, joint limits, and the outline of the hand:
/// vertices seen outside the mask are drawn into it.
class ArticulatedFit {
 public:
  /// `implementation`: of the closest-point search.
  ArticulatedFit(std::shared_ptr<const HandModel> model, const FitSchedule& schedule,
                 Implementation implementation);

  /// `previous`: the posture of the frame before, or null. `starts` is not empty.
  ArticulatedEstimate operator()(const HandObservation& seen, std::span<const ArticulatedPose> starts,
                                 const Posture* previous) const;

 private:
  std::shared_ptr<const HandModel> model_;
  std::vector<BodyShares> shares_;  ///< of the vertices
  std::vector<FaceBodies> faces_;   ///< one a triangle of the model
  FitSchedule schedule_;
  IcpConfig search_;
};

}  // namespace glovebench
