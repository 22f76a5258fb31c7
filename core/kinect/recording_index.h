#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/kinect/recording_files.h"

namespace glovebench {

inline constexpr const char* kRecordingIndex = "INDEX.txt";
/// Hours at 30 Hz.
inline constexpr uint64_t kLargestIndex = uint64_t{64} << 20;  // bytes

struct RecordingEntry {
  RecordedKind kind = RecordedKind::depth;
  int64_t timestamp_us = 0;  ///< device's clock
  std::string name;
};

std::string path_in_recording(const std::string& folder, const std::string& name);

/// Images by time, depth before color, then as listed.
/// Throws: Error if it is malformed or lists a file twice.
std::vector<RecordingEntry> parse_recording_index(std::string_view content, const std::string& folder);

/// Checks sizes and headers of the files, since fakenect ends the program at a bad one.
/// Throws: Error naming the first bad file.
void check_fakenect_dump(const std::string& folder);

}  // namespace glovebench
