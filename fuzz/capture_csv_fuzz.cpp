#include "fuzz/fuzz_target.h"
#include "trajectories/capture/csv_markers.h"
#include "trajectories/capture/import_capture.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const auto read = [](std::string_view text) {
      return trajectories::csv_markers(trajectories::parse_capture(text, "csv", Side::right, "capture.csv"));
    };
    const std::string text = read(fuzz::as_text(data, size));
    check(read(text) == text, "a capture returns");
  });
}
