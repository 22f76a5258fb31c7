#pragma once

#include <string>

#include "reports/timings.h"

namespace glovebench::eval {

/// Of the running program.
struct ProgramInfo {
  std::string version;
  std::string commit;  ///< "unknown" where it was not built from a checkout; "-dirty" after changes
};
const ProgramInfo& program_info();

/// Host, compiler, commit and date, without any times yet.
reports::Timings host_timings(int threads);

}  // namespace glovebench::eval
