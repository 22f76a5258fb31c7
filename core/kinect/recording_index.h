#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/kinect/recording_files.h"

namespace glovebench {

inline constexpr const char* kRecordingIndex = "INDEX.txt";
/// Enough for hours at 30 Hz.
inline constexpr uint64_t kLargestIndex = uint64_t{64} << 20;  // bytes

struct RecordingEntry {
  RecordedKind kind = RecordedKind::depth;
  int64_t timestamp_us = 0;  ///< by the device's clock
  std::string name;          ///< of the file
};

std::string path_in_recording(const std::string& folder, const std::string& name);

/// The images in an INDEX.txt by time, depth before color, then in order of the list.
/// Throws: Error if it is malformed or lists a file twice.
std::vector<RecordingEntry> parse_recording_index(std::string_view content, const std::string& folder);

/// Checks that fakenect can play all files; a missing or short one would end the program.
/// Throws: Error naming the first bad file, by its size and header.
void check_fakenect_dump(const std::string& folder);

}  // namespace glovebench
