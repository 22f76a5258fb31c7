#include "fuzz/fuzz_target.h"
#include "reports/comparison/stage_times.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const reports::StageTimes times =
        reports::parse_stage_times(std::string(fuzz::as_text(data, size)), "timings.json");
    const nlohmann::json written = reports::stage_times_json(times);
    const std::string where = "again";
    reports::stage_times_from(reports::JsonReader(written, where));
  });
}
