#pragma once

#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/hand/hand_model.h"
#include "trajectories/capture/marker_places.h"
#include "trajectories/capture/marker_sequence.h"
#include "trajectories/trajectory.h"

namespace glovebench::trajectories {

struct CaptureFlaws {
  double noise = 0;            ///< of each coordinate, m
  double placement = 0;        ///< of markers, relative to kPlacement
  double gap_share = 0;        ///< of all points
  double swap_share = 0;       ///< of frames with two swapped neighbors
  double unlabeled_share = 0;  ///< of all points
  uint64_t seed = 1;
};

/// Deviations, m: across, height, along. The fit assumes another.
inline const Eigen::Vector3d kPlacement(0.0015, 0.001, 0.003);
inline constexpr int kGapFrames = 4;
inline constexpr int kUnlabeledColumns = 3;

inline Eigen::Isometry3d test_T_capture_camera() {
  const Eigen::AngleAxisd turn(2.1, Eigen::Vector3d(0.3, -0.8, 0.5).normalized());
  return Eigen::Translation3d(1.2, -0.4, 0.9) * turn;
}

inline std::vector<std::string> webxr_names() {
  std::vector<std::string> names;
  for (int j = 0; j < kForearmJoint; ++j) names.push_back(joint_name(j));
  return names;
}

inline std::vector<std::string> skin_names() {
  std::vector<std::string> names = {"thumb_metacarpal", "thumb_proximal", "thumb_distal",   "thumb_tip",
                                    "wrist_radial",     "wrist_ulnar",    "forearm_radial", "forearm_ulnar"};
  for (const std::string finger : {"index", "middle", "ring", "little"})
    for (const std::string place : {"_knuckle", "_proximal", "_intermediate", "_distal", "_tip"})
      names.push_back(finger + place);
  return names;
}

inline std::vector<PlacedMarker> stuck_markers(const std::vector<std::string>& names, const HandModel& hand,
                                               const CaptureFlaws& flaws) {
  std::vector<PlacedMarker> markers;
  for (const std::string& name : names) {
    markers.push_back(place_marker(name, hand).value());
    if (markers.back().is_joint_center()) continue;
    RandomStream random(flaws.seed, name, 0, "placement");
    for (int i = 0; i < 3; ++i) markers.back().offset[i] += flaws.placement * kPlacement[i] * random.normal();
  }
  return markers;
}

inline MarkerSequence captured(const Trajectory& movement, const HandModel& hand,
                               const std::vector<std::string>& names, const CaptureFlaws& flaws) {
  const std::vector<PlacedMarker> markers = stuck_markers(names, hand, flaws);
  MarkerSequence sequence;
  sequence.names = names;
  for (size_t f = 0; f < movement.frames.size(); ++f) {
    const HandFrame& frame = movement.frames[f];
    const PosedHand posed = hand.pose(frame.posture);
    MarkerFrame& seen = sequence.frames.emplace_back(MarkerFrame{frame.timestamp_us, {}});
    for (const PlacedMarker& marker : markers) {
      RandomStream random(flaws.seed, marker.name, static_cast<int64_t>(f), "noise");
      const Eigen::Isometry3d T_hand_bone = marker.joint == kPalm
                                                ? Eigen::Isometry3d::Identity()
                                                : posed.T_hand_joint[static_cast<size_t>(marker.joint)];
      const Eigen::Vector3d p = test_T_capture_camera() * frame.T_camera_hand * T_hand_bone * marker.offset;
      seen.points.push_back(p + flaws.noise * Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
    }
  }
  return sequence;
}

inline MarkerSequence flawed(MarkerSequence sequence, const CaptureFlaws& flaws) {
  const size_t markers = sequence.names.size();
  for (int u = 0; u < kUnlabeledColumns; ++u) sequence.names.push_back("unlabeled_" + std::to_string(u + 1));
  for (size_t f = 0; f < sequence.frames.size(); ++f) {
    std::vector<Eigen::Vector3d>& points = sequence.frames[f].points;
    points.resize(sequence.names.size(), gap());
    RandomStream random(flaws.seed, "capture", static_cast<int64_t>(f), "swaps");
    if (random.uniform() < flaws.swap_share) {
      const size_t m = random.index(markers - 1);
      std::swap(points[m], points[m + 1]);
    }
    size_t column = markers;
    for (size_t m = 0; m < markers && column < points.size(); ++m)
      if (random.uniform() < flaws.unlabeled_share) std::swap(points[m], points[column++]);
    for (size_t m = 0; m < markers; ++m) {
      RandomStream gaps(flaws.seed, sequence.names[m], static_cast<int64_t>(f) / kGapFrames, "gaps");
      if (gaps.uniform() < flaws.gap_share) points[m] = gap();
    }
  }
  return sequence;
}

}  // namespace glovebench::trajectories
