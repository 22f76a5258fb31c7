#include "core/base/fuzz_target.h"
#include "trajectories/posture_file.h"

namespace glovebench {

void posture_table_fuzz(std::string_view bytes) {
  const PostureSet set = trajectories::parse_postures_csv(bytes, "set", "set.csv");
  trajectories::parse_postures_json(trajectories::canonical_text(set), "again");
}

}  // namespace glovebench
