#pragma once

#include <cstdint>
#include <string>

namespace glovebench::bench {

/// Resident memory of this process, bytes.
struct ResidentMemory {
  int64_t anonymous = 0;  ///< its own
  int64_t file = 0;       ///< pages of files, which the system can take back
  int64_t peak = 0;       ///< of both together, since the last `reset_peak`
};
ResidentMemory resident_memory();
void reset_peak();

/// Page faults of this process since it began: what was read from a disk, and what was in memory already.
struct PageFaults {
  int64_t major = 0, minor = 0;
};
PageFaults page_faults();

/// Takes all pages of a file out of this process's memory and out of the system's cache, unless another process has
/// them mapped. What was written must have been flushed. Throws Error if there is no such file.
void drop_from_memory(const std::string& path);

}  // namespace glovebench::bench
