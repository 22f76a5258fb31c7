#include <limits>

#include "core/kinect/recording_index.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    int64_t last_us = std::numeric_limits<int64_t>::min();
    for (const RecordingEntry& entry : parse_recording_index(fuzz::as_text(data, size), "folder")) {
      check(entry.timestamp_us >= last_us, "an index comes in order of time");
      last_us = entry.timestamp_us;
    }
  });
}
