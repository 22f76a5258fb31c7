#include "core/base/fuzz_target.h"
#include "trajectories/capture/csv_markers.h"
#include "trajectories/capture/import_capture.h"

namespace glovebench {

void capture_csv_fuzz(std::string_view bytes) {
  const auto read = [](std::string_view text) {
    return trajectories::csv_markers(trajectories::parse_capture(text, "csv", Side::right, "capture.csv"));
  };
  const std::string text = read(bytes);
  check(read(text) == text, "a capture returns");
}

}  // namespace glovebench
