#include "core/kinect/recording_files.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const RecordedName name = parse_recorded_name(fuzz::as_text(data, size), "INDEX.txt");
    const RecordedName again = parse_recorded_name(recorded_name(name), "INDEX.txt");
    check(again.timestamp_us == name.timestamp_us && again.kind == name.kind, "a name returns");
  });
}
