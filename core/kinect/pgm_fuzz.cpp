#include "core/base/fuzz_target.h"
#include "core/kinect/recording_files.h"

namespace glovebench {

void pgm_fuzz(std::string_view bytes) {
  const Image<uint16_t> image = decode_pgm(bytes, 4, 3, "image");
  check(decode_pgm(encode_pgm(image), 4, 3, "again") == image, "an image returns");
}

}  // namespace glovebench
