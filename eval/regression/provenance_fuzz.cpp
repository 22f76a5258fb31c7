#include "core/base/fuzz_target.h"
#include "eval/regression/baseline.h"

namespace glovebench {

void provenance_fuzz(std::string_view bytes) { eval::parse_provenance(std::string(bytes), "provenance.json"); }

}  // namespace glovebench
