// glovebench_bench [--cache FOLDER] [--database NAME] [Google Benchmark's options]

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "bench/bench_data.h"
#include "bench/ratio_reporter.h"
#include "core/base/error.h"

namespace glovebench::bench {
namespace {

std::string default_cache_folder() {
  const char* chosen = std::getenv("GLOVEBENCH_CACHE");
  return chosen != nullptr ? chosen : (std::filesystem::temp_directory_path() / "glovebench-bench").string();
}

/// Takes the options of this program; what is left is Google Benchmark's.
Settings parse(int argc, char** argv) {
  Settings settings{.cache_folder = default_cache_folder()};
  for (int i = 1; i < argc; i += 2) {
    const std::string option = argv[i];
    if (option != "--cache" && option != "--database") {
      throw Error("command line", option, "an unknown option",
                  "--cache FOLDER, --database NAME or an option of Google Benchmark (--help)");
    }
    if (i + 1 == argc) throw Error("command line", option, "nothing after it", "a value");
    (option == "--cache" ? settings.cache_folder : settings.database) = argv[i + 1];
  }
  return settings;
}

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  prepare(parse(argc, argv));
  RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  return reporter.error_count() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace glovebench::bench

int main(int argc, char** argv) {
  try {
    return glovebench::bench::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "glovebench_bench: {}\n", error.what());
    return 2;
  }
}
