#include "core/base/fuzz_target.h"
#include "core/kinect/recording_files.h"

namespace glovebench {

void recorded_name_fuzz(std::string_view bytes) {
  const RecordedName name = parse_recorded_name(bytes, "INDEX.txt");
  const RecordedName again = parse_recorded_name(recorded_name(name), "INDEX.txt");
  check(again.timestamp_us == name.timestamp_us && again.kind == name.kind, "a name returns");
}

}  // namespace glovebench
