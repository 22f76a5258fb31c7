#include "core/base/fuzz_target.h"
#include "reports/comparison/noise_floor.h"

namespace glovebench {

void noise_floor_fuzz(std::string_view bytes) {
  const reports::NoiseFloor floor = reports::parse_noise_floor(std::string(bytes), "noise_floor.json");
  without_error([&] { reports::parse_noise_floor(reports::noise_floor_json(floor), "again"); });
}

}  // namespace glovebench
