#include "eval/program_info.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "eval/commit.h"

namespace glovebench::eval {
namespace {

std::string host_name() {
  char name[256] = {};
  return gethostname(name, sizeof(name) - 1) == 0 ? name : "unknown";
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

}  // namespace

const ProgramInfo& program_info() {
  static const ProgramInfo info{GLOVEBENCH_VERSION, kCommit};
  return info;
}

reports::Timings host_timings(int threads) {
  reports::Timings timings;
  timings.host = host_name();
  timings.processor = processor_name();
  timings.threads = threads;
#ifdef __VERSION__
  timings.compiler = __VERSION__;
#endif
  timings.build_type = GLOVEBENCH_BUILD_TYPE;
  timings.commit = program_info().commit;
  timings.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                             fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
  return timings;
}

}  // namespace glovebench::eval
