#include "core/kinect/recording_files.h"
#include "fuzz/fuzz_target.h"

using namespace glovebench;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return fuzz::expect_value_or_error([&] {
    const Image<uint16_t> image = decode_pgm(fuzz::as_text(data, size), 4, 3, "image");
    check(decode_pgm(encode_pgm(image), 4, 3, "again") == image, "an image returns");
  });
}
