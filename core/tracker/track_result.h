#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/enum_names.h"
#include "core/database/look_up.h"
#include "core/hand/posture.h"

namespace glovebench {

/// A frame that is not `tracked` is lost. It repeats the last tracked posture and pose (at first: the open hand at
/// the origin). `articulated` can follow a hand that the border cuts: then its frame is `tracked`.
enum class TrackStatus {
  tracked,
  no_hand,         ///< too few glove pixels
  outside_volume,  ///< over a third of the glove is too near or too far
  cut_by_border,   ///< the glove touches the border over too long a stretch
  several_hands,   ///< another large glove-colored object
  too_few_points,
  degenerate_cloud,  ///< points on one line
  no_shared_color,   ///< cloud and visible model share none
  poor_match,        ///< error above `max_matching_error`
  poor_alignment,    ///< distance above `max_residual`
  missing,           ///< no estimate by another program
};
constexpr auto names_of(TrackStatus) {
  return std::to_array<std::string_view>({"tracked", "no_hand", "outside_volume", "cut_by_border", "several_hands",
                                          "too_few_points", "degenerate_cloud", "no_shared_color", "poor_match",
                                          "poor_alignment", "missing"});
}
static_assert(kCountOf<TrackStatus> == static_cast<int>(TrackStatus::missing) + 1, "each value has a name");

struct AngleCertainty {
  Posture deviation = Posture::Zero();  ///< standard deviations, rad
  uint32_t hidden = 0;                  ///< bit a: angle a is hardly seen
};

/// What an estimate has. Another program's may lack some.
struct EstimateParts {
  bool posture = true;
  bool pose = true;
  bool place = true;      ///< false: joints have camera axes, but no place
  bool scale = true;      ///< false: joints have no unit
  bool internals = true;  ///< unfiltered posture, matches, alignment

  bool hand() const { return posture && pose; }
};

/// The result for one frame, (theta, R, P).
/// Paper: section III-C.
struct TrackResult {
  int64_t timestamp_us = 0;  ///< of the depth image
  TrackStatus status = TrackStatus::no_hand;
  std::string reason;  ///< of `missing` from a program that runs

  Posture posture = Posture::Zero();                                ///< smoothed, rad
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();  ///< smoothed, m

  Posture posture_unfiltered = Posture::Zero();  ///< rad
  Eigen::Isometry3d T_camera_hand_unfiltered = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_camera_hand_coarse = Eigen::Isometry3d::Identity();
  RecycledVector<Match> matches;  ///< none if a cut hand was followed

  EstimateParts has;
  /// By joint without the forearm, camera axes, m. Empty: those of the tracker's hand in this posture and pose.
  RecycledVector<std::optional<Eigen::Vector3d>> joints;

  bool ambiguous = false;  ///< matches' rotations differ by over 60 degrees
  bool converged = false;
  int cloud_points = 0;  ///< |C|
  int icp_points = 0;
  int icp_iterations = 0;
  double icp_residual = 0;  ///< final mean point-to-triangle distance, m
  std::optional<AngleCertainty> certainty;
  /// RMS of the patches' mean signed distances from the refined hand, m. Large if the model has wrong sizes.
  std::optional<double> misfit;
};

/// Stages in the order of a frame.
enum class Stage {
  registration,
  segmentation,
  cloud,
  detection,
  tiny_images,
  look_up,
  alignment,
  placement,
  mask,
  fit,
  smoothing,
  answer  ///< of a tracker program, from the frame on
};
/// As in timings.json.
constexpr auto names_of(Stage) {
  return std::to_array<std::string_view>({"register", "segment", "cloud", "detect", "tiny_images", "look_up",
                                          "align", "place", "mask", "fit", "smooth", "answer"});
}
static_assert(kCountOf<Stage> == static_cast<int>(Stage::answer) + 1, "each value has a name");

/// Called when a stage begins. A frame may enter a stage twice. Must not be empty.
using StageObserver = std::function<void(Stage stage)>;
inline void unobserved(Stage) {}

/// JSON without line end: frame, timestamp_us, status, angles_deg, position_mm, quaternion_wxyz,
/// matching_error_px, icp_iterations, icp_residual_mm, ambiguous, converged; if known, joints_mm,
/// angle_deviations_deg and hidden (names). Lacks what the result lacks; if lost, also posture and pose.
std::string estimate_line(int frame, const TrackResult& result);

}  // namespace glovebench
