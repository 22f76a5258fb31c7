#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/kinect/recording_files.h"

namespace glovebench {

inline constexpr const char* kRecordingIndex = "INDEX.txt";
/// Hours of frames at 30 Hz.
inline constexpr uint64_t kLargestIndex = uint64_t{64} << 20;  // bytes

/// One image of a recording (see recording.h).
struct RecordingEntry {
  RecordedKind kind = RecordedKind::depth;
  int64_t timestamp_us = 0;  ///< by the device's clock
  std::string name;          ///< of its file in the folder
};

std::string path_in_recording(const std::string& folder, const std::string& name);

/// The images that the content of an INDEX.txt lists, in order of time; of equal times (a device may repeat one) in
/// that of the list. Throws Error if it is malformed or lists a file twice.
std::vector<RecordingEntry> parse_recording_index(std::string_view content, const std::string& folder);

/// Throws Error naming the first file that the fakenect library could not play: it ends the program, or reads past
/// the end, where a file is missing or short. Looks at sizes and headers only.
void check_fakenect_dump(const std::string& folder);

}  // namespace glovebench
