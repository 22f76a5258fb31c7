#include "core/adapters/pictures/picture_files.h"
#include "core/base/fuzz_target.h"
#include "core/camera/pinhole_camera.h"

namespace glovebench {

void picture_fuzz(std::string_view bytes) {
  const auto expect_bounded = [](const auto& image) {
    check(image.size() > 0 && image.size() <= kMostPixels, "a picture is as large as one may be");
  };
  expect_value_or_error([&] { expect_bounded(decode_gray(bytes, "picture.png")); });
  expect_value_or_error([&] { expect_bounded(decode_deep(bytes, "picture.png")); });
}

}  // namespace glovebench
