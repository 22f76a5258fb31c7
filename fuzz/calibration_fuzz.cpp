#include <nlohmann/json.hpp>

#include "core/camera/rgbd_calibration.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const RgbdCalibration calibration = calibration_from_text(fuzz::as_text(data, size), "calibration.json");
    const std::string written = to_json(calibration).dump();
    check(to_json(calibration_from_text(written, "again")).dump() == written, "a calibration returns");
  });
}
