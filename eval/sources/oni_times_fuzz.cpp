#include "core/base/fuzz_target.h"
#include "eval/sources/oni_source.h"

namespace glovebench {

void oni_times_fuzz(std::string_view bytes) { eval::parse_oni_times(bytes, "a.oni"); }

}  // namespace glovebench
