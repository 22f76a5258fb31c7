#include "fuzz/captured_points.h"
#include "trajectories/capture/import_capture.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  for (const Side side : {Side::right, Side::left})
    fuzz::expect_points_or_error(
        [&] { return trajectories::parse_capture(fuzz::as_text(data, size), "webxr", side, "capture.webxr"); });
  return 0;
}
