#include "core/base/fuzz_target.h"
#include "trajectories/posture_file.h"

namespace glovebench {

void posture_set_fuzz(std::string_view bytes) {
  const std::string text = trajectories::canonical_text(trajectories::parse_postures_json(bytes, "postures.json"));
  check(trajectories::canonical_text(trajectories::parse_postures_json(text, "again")) == text, "a set returns");
}

}  // namespace glovebench
