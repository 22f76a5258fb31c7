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

inline constexpr int kPalm = -1;  ///< instead of a joint: the hand frame

/// WebXR names 25 joints ("wrist", ..., "pinky-finger-tip"). Points with these names are joint centers, unlike a
/// marker on the skin, in every format.
inline constexpr int kWebxrJointCount = kForearmJoint;  ///< the forearm is ours
bool is_webxr_joint(const std::string& name);
/// All of them, without a frame.
MarkerSequence sequence_of_joints();

/// Where a point of a capture sits: fixed in the frame of a joint, or of the hand (kPalm).
struct PlacedMarker {
  std::string name;
  int joint = kPalm;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< m, in that frame
  /// How far a capture's own marker may sit from there, standard deviation of each coordinate, m; zero of a joint
  /// center, which sits there.
  Eigen::Vector3d deviation = Eigen::Vector3d::Zero();

  bool is_joint_center() const { return deviation.isZero(); }
};

inline constexpr uint64_t kLargestMarkerLayout = uint64_t{1} << 20;  // bytes

/// A layout: the place of each marker whose name is none.
using MarkerLayout = std::map<std::string, std::string>;
/// Reads the format "glovebench-marker-layout" (README.md). Throws Error.
MarkerLayout parse_marker_layout(std::string_view text, const std::string& where);

/// The place that a name says, on the skin of a right hand: FINGER_proximal, FINGER_intermediate, FINGER_distal,
/// FINGER_tip, FINGER_knuckle, thumb_metacarpal, hand_back, wrist, wrist_radial, wrist_ulnar, forearm,
/// forearm_radial, forearm_ulnar, each also with a number ("index_proximal_2"); or the joint that a WebXR name
/// says. README.md. Nothing if there is no such place.
std::optional<PlacedMarker> place_marker(const std::string& name, const HandModel& model);

/// The places of a sequence's labeled points. Throws Error naming `where` and the point if there is no such place,
/// or the layout's name of one is not in the sequence.
std::vector<PlacedMarker> place_markers(const std::vector<std::string>& names, const MarkerLayout& layout,
                                        const HandModel& model, const std::string& where);

}  // namespace glovebench::trajectories
