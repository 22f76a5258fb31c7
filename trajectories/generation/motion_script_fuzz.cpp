#include "core/base/fuzz_target.h"
#include "trajectories/generation/motion_script.h"

namespace glovebench {

void motion_script_fuzz(std::string_view bytes) {
  const PostureSet gestures{.name = "g", .posture_names = {"open"}, .postures = {Posture::Zero()}};
  const trajectories::MotionScript script = trajectories::parse_motion_script(bytes, gestures, "script.json");
  check(script.frame_count >= 2 && script.postures.front().frame == 0, "a script has keys from the first frame");
}

}  // namespace glovebench
