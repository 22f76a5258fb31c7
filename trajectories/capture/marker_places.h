#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/hand/hand_model.h"
#include "core/hand/skeleton.h"
#include "trajectories/capture/marker_sequence.h"

namespace glovebench::trajectories {

inline constexpr int kPalm = -1;  ///< the hand frame

/// WebXR's names are joint centers, other markers lie on the skin.
inline constexpr int kWebxrJointCount = kForearmJoint;
bool is_webxr_joint(const std::string& name);
/// All joint centers, without frames.
MarkerSequence sequence_of_joints();

/// A point fixed to a joint or, for kPalm, the hand.
struct PlacedMarker {
  std::string name;
  int joint = kPalm;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< m
  /// standard deviations, m; 0 for a joint center
  Eigen::Vector3d deviation = Eigen::Vector3d::Zero();

  bool is_joint_center() const { return deviation.isZero(); }
};

/// Places of other names.
using MarkerLayout = std::map<std::string, std::string>;
/// Reads "glovebench-marker-layout" (README.md).
/// Throws: Error.
MarkerLayout parse_marker_layout(std::string_view text, const std::string& where);

/// Empty if `path` is empty.
/// Throws: Error.
MarkerLayout load_marker_layout(const std::string& path);

/// The place on a right hand. Empty unless `name` is of README.md ("index_proximal_2") or WebXR.
std::optional<PlacedMarker> place_marker(const std::string& name, const HandModel& model);

/// Throws: Error for a point without place, or a layout name without point.
std::vector<PlacedMarker> place_markers(const std::vector<std::string>& names, const MarkerLayout& layout,
                                        const HandModel& model, const std::string& where);

}  // namespace glovebench::trajectories
