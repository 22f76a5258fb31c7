#include "core/base/fuzz_target.h"
#include "trajectories/capture/marker_places.h"

namespace glovebench {

void marker_layout_fuzz(std::string_view bytes) {
  const trajectories::MarkerLayout layout = trajectories::parse_marker_layout(bytes, "layout.json");
  for (const auto& [name, place] : layout) check(!place.empty(), "a place has a name");
}

}  // namespace glovebench
