#include "calibration/color_seeds.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    for (const calibration::Chroma& seed : calibration::parse_glove_colors(fuzz::as_text(data, size), "glove.json"))
      check(seed.allFinite(), "a color has a chroma");
  });
}
