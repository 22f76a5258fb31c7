#include <limits>

#include "core/base/fuzz_target.h"
#include "core/kinect/recording_files.h"

namespace glovebench {

void recording_index_fuzz(std::string_view bytes) {
  int64_t last_us = std::numeric_limits<int64_t>::min();
  for (const RecordingEntry& entry : parse_recording_index(bytes, "folder")) {
    check(entry.timestamp_us >= last_us, "an index comes in order of time");
    last_us = entry.timestamp_us;
  }
}

}  // namespace glovebench
