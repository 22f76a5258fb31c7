#include "core/base/fuzz_target.h"
#include "reports/comparison/speed.h"

namespace glovebench {

void speed_ratios_fuzz(std::string_view bytes) {
  const std::vector<reports::SpeedRatio> ratios = reports::parse_speed_ratios(std::string(bytes), "speed.json");
  for (const reports::SpeedRatio& ratio : ratios) check(ratio.low <= ratio.high, "a ratio has a range");
  without_error([&] { reports::parse_speed_ratios(reports::speed_json(ratios), "again"); });
}

}  // namespace glovebench
