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

/// What became of one frame. Everything but `tracked` is a lost frame: its posture and pose are the last
/// tracked ones (or the open hand at the origin before there was any) and must not be used as a measurement.
enum class TrackStatus {
  tracked,
  no_hand,           ///< too few glove pixels in view
  outside_volume,    ///< the glove or a third of it is nearer or farther than the working volume
  cut_by_border,     ///< the glove touches the image border over a long stretch: the box is not the hand's
  several_hands,     ///< more than one large glove-colored object
  too_few_points,    ///< fewer than three usable points
  degenerate_cloud,  ///< the points lie on one line: no rotation can be told
  no_shared_color,   ///< the cloud and the visible model share no color
  poor_match,        ///< the nearest database entry is farther than `max_matching_error`
  poor_alignment,    ///< the mean distance after alignment is above `max_residual`
};
constexpr auto names_of(TrackStatus) {
  return std::to_array<std::string_view>({"tracked", "no_hand", "outside_volume", "cut_by_border", "several_hands",
                                          "too_few_points", "degenerate_cloud", "no_shared_color", "poor_match",
                                          "poor_alignment"});
}
static_assert(kCountOf<TrackStatus> == static_cast<int>(TrackStatus::poor_alignment) + 1, "each value has a name");

/// What a method knows of the angles that it gives.
struct AngleCertainty {
  Posture deviation = Posture::Zero();  ///< standard deviation of each angle, rad
  uint32_t hidden = 0;  ///< bit a: hardly a point of what angle a moves was seen; the angle is the prior's
};

/// The tracker's answer for one frame: (theta, R, P) of section III-C and what led to it.
struct TrackResult {
  int64_t timestamp_us = 0;  ///< of the depth image
  TrackStatus status = TrackStatus::no_hand;

  Posture posture = Posture::Zero();                                ///< theta, smoothed, rad
  Eigen::Isometry3d T_camera_hand = Eigen::Isometry3d::Identity();  ///< smoothed, m

  Posture posture_unfiltered = Posture::Zero();  ///< of the look-up, rad
  Eigen::Isometry3d T_camera_hand_unfiltered = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_camera_hand_coarse = Eigen::Isometry3d::Identity();  ///< before the alignment
  RecycledVector<Match> matches;

  bool ambiguous = false;  ///< the matches' rotations spread over more than 60 degrees
  bool converged = false;  ///< of the alignment
  int cloud_points = 0;    ///< |C|
  int icp_points = 0;      ///< used by the alignment
  int icp_iterations = 0;
  double icp_residual = 0;                  ///< mean point-to-triangle distance at the end, m
  std::optional<AngleCertainty> certainty;  ///< of methods that know it
};

/// The stages of the methods, in the order of a frame.
enum class Stage { registration, segmentation, cloud, detection, tiny_images, look_up, alignment, placement, mask, fit,
                   smoothing };
/// As in timings.json.
constexpr auto names_of(Stage) {
  return std::to_array<std::string_view>({"register", "segment", "cloud", "detect", "tiny_images", "look_up", "align",
                                          "place", "mask", "fit", "smooth"});
}
static_assert(kCountOf<Stage> == static_cast<int>(Stage::smoothing) + 1, "each value has a name");

/// Called when a stage begins, so that a caller with a clock can time it. A frame may enter a stage twice.
using StageObserver = std::function<void(Stage stage)>;
/// Observes nothing.
inline void unobserved(Stage) {}

/// One estimate as one line of JSON (no line end): frame, timestamp_us, status, angles_deg (22, filtered),
/// position_mm, quaternion_wxyz, matching_error_px, icp_iterations, icp_residual_mm, ambiguous, converged; of a
/// method that knows them also angle_deviations_deg (22) and hidden (names of angles). A lost frame has no posture
/// and no pose. Numbers to 1e-6 of their unit, so equal estimates are equal bytes.
std::string estimate_line(int frame, const TrackResult& result);

}  // namespace glovebench
