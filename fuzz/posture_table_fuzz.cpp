#include "fuzz/fuzz_target.h"
#include "trajectories/posture_file.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const PostureSet set = trajectories::parse_postures_csv(fuzz::as_text(data, size), "set", "set.csv");
    trajectories::parse_postures_json(trajectories::canonical_text(set), "again");
  });
}
