#pragma once

#include <map>
#include <optional>
#include <string>

namespace glovebench::reports {

struct FrameRecord;

// The rules of coverage. They stand in the protocol of each result, and no tracker's configuration changes them: a
// new rule is a new protocol.

/// The hand is visible if at least this share of its camera-facing area is in both images and in the volume.
inline constexpr double kVisible_percent = 30;
inline constexpr double kVolumeNear_mm = 400, kVolumeFar_mm = 950;  ///< z in the IR camera's frame
/// A frame is found, or "covered", below these errors.
inline constexpr double kFoundPosition_mm = 50, kFoundRotation_deg = 30;
/// A frame is usable below these errors.
inline constexpr double kUsablePosition_mm = 10, kUsableRotation_deg = 10;
inline constexpr double kUsableFingertips_mm = 20;  ///< mean of the five

/// All of the above by name.
std::map<std::string, double> coverage_rules();

// Errors are compared as files hold them (rounded to 1e-6), so a result that is read counts as the one written.

/// False for a frame of an older result, which does not say how much of the hand was visible.
bool is_visible(const FrameRecord& frame);
/// Tracked and below the usable errors. An error that the result lacks contradicts nothing.
bool is_usable(const FrameRecord& frame);

}  // namespace glovebench::reports
