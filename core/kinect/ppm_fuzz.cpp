#include "core/base/fuzz_target.h"
#include "core/kinect/recording_files.h"

namespace glovebench {

void ppm_fuzz(std::string_view bytes) {
  const ColorImage image = decode_ppm(bytes, 4, 3, "image");
  check(decode_ppm(encode_ppm(image), 4, 3, "again") == image, "an image returns");
}

}  // namespace glovebench
