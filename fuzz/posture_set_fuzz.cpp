#include "fuzz/fuzz_target.h"
#include "trajectories/posture_file.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const std::string text =
        trajectories::canonical_text(trajectories::parse_postures_json(fuzz::as_text(data, size), "postures.json"));
    check(trajectories::canonical_text(trajectories::parse_postures_json(text, "again")) == text, "a set returns");
  });
}
