#include "fuzz/fuzz_target.h"
#include "trajectories/capture/marker_places.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const trajectories::MarkerLayout layout =
        trajectories::parse_marker_layout(fuzz::as_text(data, size), "layout.json");
    for (const auto& [name, place] : layout) check(!place.empty(), "a place has a name");
  });
}
