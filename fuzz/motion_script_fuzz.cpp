#include "fuzz/fuzz_target.h"
#include "trajectories/generation/motion_script.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const PostureSet gestures{.name = "g", .posture_names = {"open"}, .postures = {Posture::Zero()}};
    const trajectories::MotionScript script =
        trajectories::parse_motion_script(fuzz::as_text(data, size), gestures, "script.json");
    check(script.frame_count >= 2 && script.postures.front().frame == 0, "a script has keys from the first frame");
  });
}
