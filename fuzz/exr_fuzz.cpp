#include "fuzz/fuzz_target.h"
#include "render/exr.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error(
      [&] { render::parse_exr(std::string(fuzz::as_text(data, size)), "frame.exr"); });
}
