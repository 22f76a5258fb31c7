#pragma once

#include <string>

#include "reports/timings.h"

namespace glovebench::eval {

struct ProgramInfo {
  std::string version;
  std::string commit;  ///< "unknown" if not built from a checkout; "-dirty" after changes
};
const ProgramInfo& program_info();

/// No times yet.
reports::Timings host_timings(int threads);

}  // namespace glovebench::eval
