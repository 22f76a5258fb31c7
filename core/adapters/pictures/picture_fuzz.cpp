#include "core/adapters/pictures/picture_files.h"
#include "core/base/fuzz_target.h"
#include "core/camera/pinhole_camera.h"

namespace glovebench {

void picture_fuzz(std::string_view bytes) {
  const Image<uint8_t> gray = decode_gray(bytes, "picture.png");
  check(gray.size() > 0 && gray.size() <= kMostPixels, "a picture is as large as one may be");
}

}  // namespace glovebench
