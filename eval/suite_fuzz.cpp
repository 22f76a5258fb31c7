#include "core/base/fuzz_target.h"
#include "eval/suite.h"

namespace glovebench {

void suite_fuzz(std::string_view bytes) {
  const eval::Suite suite = eval::parse_suite(bytes, "suite.json");
  check(!suite.seeds.empty() && !suite.entries.empty(), "a suite has seeds and experiments");
}

}  // namespace glovebench
