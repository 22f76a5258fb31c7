#include "core/base/fuzz_target.h"
#include "core/calibration/color_seeds.h"

namespace glovebench {

void glove_colors_fuzz(std::string_view bytes) {
  for (const calibration::Chroma& seed : calibration::parse_glove_colors(bytes, "glove.json"))
    check(seed.allFinite(), "a color has a chroma");
}

}  // namespace glovebench
