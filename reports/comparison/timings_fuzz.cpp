#include "core/base/fuzz_target.h"
#include "reports/comparison/stage_times.h"

namespace glovebench {

void timings_fuzz(std::string_view bytes) {
  const reports::StageTimes times = reports::parse_stage_times(std::string(bytes), "timings.json");
  const nlohmann::json written = reports::stage_times_json(times);
  const std::string where = "again";
  without_error([&] { reports::stage_times_from(JsonCursor(written, where)); });
}

}  // namespace glovebench
