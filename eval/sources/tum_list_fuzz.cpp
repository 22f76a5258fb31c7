#include "core/base/fuzz_target.h"
#include "core/base/text.h"
#include "eval/sources/tum_source.h"

namespace glovebench {

void tum_list_fuzz(std::string_view bytes) {
  for (const eval::TumImage& image : eval::parse_tum_list(bytes, "rgb.txt")) {
    check(image.timestamp_us >= 0, "a time is not negative");
    check(path_within("folder", image.name).starts_with("folder/"), "a file lies in the folder");
  }
}

}  // namespace glovebench
