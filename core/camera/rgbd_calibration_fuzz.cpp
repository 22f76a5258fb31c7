#include <nlohmann/json.hpp>

#include "core/base/fuzz_target.h"
#include "core/camera/rgbd_calibration.h"

namespace glovebench {

void rgbd_calibration_fuzz(std::string_view bytes) {
  const RgbdCalibration calibration = calibration_from_text(bytes, "calibration.json");
  const std::string written = to_json(calibration).dump();
  check(to_json(calibration_from_text(written, "again")).dump() == written, "a calibration returns");
}

}  // namespace glovebench
