#include "core/base/fuzz_target.h"
#include "render/test_exr.h"

namespace glovebench {

void exr_fuzz(std::string_view bytes) { render::parse_exr(std::string(bytes), "frame.exr"); }

}  // namespace glovebench
