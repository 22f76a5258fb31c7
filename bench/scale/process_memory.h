#pragma once

#include <cstdint>
#include <string>

namespace glovebench::bench {

/// Bytes.
struct ResidentMemory {
  int64_t anonymous = 0;
  int64_t file = 0;  ///< the system can take it back
  int64_t peak = 0;  ///< of the sum, since `reset_peak`
};
ResidentMemory resident_memory();
void reset_peak();

/// Major page faults read from disk.
struct PageFaults {
  int64_t major = 0, minor = 0;
};
PageFaults page_faults();

/// Drops a flushed file's pages from process and system cache, unless another process maps them.
/// Throws: Error.
void drop_from_memory(const std::string& path);

}  // namespace glovebench::bench
