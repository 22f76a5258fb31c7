#pragma once

#include <string>
#include <string_view>

#include "core/hand/posture.h"
#include "trajectories/capture/marker_sequence.h"

namespace glovebench::trajectories {

/// The points of a sequence that are named like the 25 joints of WebXR ("wrist", ..., "pinky-finger-tip") are joint
/// centers: nothing to fit, unlike a marker on the skin. Every reader's points may be.
bool is_webxr_joint(const std::string& name);

/// Reads joint positions as a page records them from XRFrame.getJointPose: format "glovebench-webxr-joints"
/// (README.md). Joints that a frame does not name are gaps. `where` names the text in messages. Throws Error.
MarkerSequence parse_webxr_joints(std::string_view text, const std::string& where);

/// Reads one hand of a pose file of npm handy-work: little-endian floats, the number of joints (25), a matrix by
/// columns for each joint of the left and of the right hand (m), and two weights a joint. Throws Error.
MarkerSequence parse_handpose(std::string_view bytes, Side side, const std::string& where);

}  // namespace glovebench::trajectories
