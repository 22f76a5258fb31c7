#include "bench/scale/process_memory.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/error.h"

namespace glovebench::bench {

ResidentMemory resident_memory() {
  ResidentMemory memory;
  std::ifstream status("/proc/self/status");
  for (std::string name; status >> name;) {
    int64_t kib = 0;
    if (name == "RssAnon:" && status >> kib) memory.anonymous = 1024 * kib;
    if (name == "RssFile:" && status >> kib) memory.file = 1024 * kib;
    if (name == "VmHWM:" && status >> kib) memory.peak = 1024 * kib;
    std::getline(status, name);
  }
  return memory;
}

void reset_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

PageFaults page_faults() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return {usage.ru_majflt, usage.ru_minflt};
}

void drop_from_memory(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw Error(path, "file", std::strerror(errno), "a readable file");
  const std::string canonical = std::filesystem::canonical(path);
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    if (!line.ends_with(" " + canonical)) continue;
    uintptr_t begin = 0, end = 0;
    char dash = 0;
    if (std::istringstream(line) >> std::hex >> begin >> dash >> end)
      ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_DONTNEED);  // NOLINT(performance-no-int-to-ptr)
  }
  ::posix_fadvise(descriptor, 0, 0, POSIX_FADV_DONTNEED);
  ::close(descriptor);
}

}  // namespace glovebench::bench
