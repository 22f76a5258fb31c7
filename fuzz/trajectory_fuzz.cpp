#include "fuzz/fuzz_target.h"
#include "trajectories/trajectory.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const std::string text =
        canonical_text(trajectories::parse_trajectory(fuzz::as_text(data, size), "trajectory.json"));
    check(canonical_text(trajectories::parse_trajectory(text, "again")) == text, "a trajectory returns");
  });
}
