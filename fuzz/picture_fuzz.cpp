#include "calibration/board_views.h"
#include "core/camera/pinhole_camera.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const Image<uint8_t> gray = calibration::decode_gray(fuzz::as_text(data, size), "picture.png");
    check(gray.size() > 0 && gray.size() <= kMostPixels, "a picture is as large as one may be");
  });
}
