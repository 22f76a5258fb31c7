#include "fuzz/fuzz_target.h"
#include "reports/comparison/noise_floor.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const reports::NoiseFloor floor =
        reports::parse_noise_floor(std::string(fuzz::as_text(data, size)), "noise_floor.json");
    reports::parse_noise_floor(reports::noise_floor_json(floor), "again");
  });
}
