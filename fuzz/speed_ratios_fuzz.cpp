#include "fuzz/fuzz_target.h"
#include "reports/comparison/speed.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const std::vector<reports::SpeedRatio> ratios =
        reports::parse_speed_ratios(std::string(fuzz::as_text(data, size)), "speed.json");
    for (const reports::SpeedRatio& ratio : ratios) check(ratio.low <= ratio.high, "a ratio has a range");
    reports::parse_speed_ratios(reports::speed_json(ratios), "again");
  });
}
