#pragma once

#include <cstdint>
#include <string>

namespace glovebench::bench {

/// Resident memory, bytes.
struct ResidentMemory {
  int64_t anonymous = 0;
  int64_t file = 0;  ///< pages that the system can take back
  int64_t peak = 0;  ///< of their sum, since `reset_peak`
};
ResidentMemory resident_memory();
void reset_peak();

/// Page faults read from disk (major) and memory (minor).
struct PageFaults {
  int64_t major = 0, minor = 0;
};
PageFaults page_faults();

/// Removes a flushed file's pages from process and system cache, unless another process maps them.
/// Throws: Error if it is missing.
void drop_from_memory(const std::string& path);

}  // namespace glovebench::bench
