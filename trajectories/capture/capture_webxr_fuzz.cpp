#include "trajectories/capture/captured_points.h"
#include "trajectories/capture/import_capture.h"

namespace glovebench {

void capture_webxr_fuzz(std::string_view bytes) {
  for (const Side side : {Side::right, Side::left})
    expect_points_or_error([&] { return trajectories::parse_capture(bytes, "webxr", side, "capture.webxr"); });
}

}  // namespace glovebench
