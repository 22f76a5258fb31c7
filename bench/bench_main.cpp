// glovebench_bench [--cache FOLDER] [--database NAME] [--frames SET] [--colors SET] [--simd NAME]
//   [--table FILE] [Google Benchmark's options]

#include <fmt/format.h>
#include <hwy/targets.h>
#include <unistd.h>

#include <map>

#include "bench/bench_data.h"
#include "bench/speed_table.h"
#include "core/base/error.h"
#include "core/base/whole_file.h"

namespace glovebench::bench {
namespace {

struct Options {
  Settings settings{.cache_folder = default_cache_folder()};
  std::string simd;   ///< the best instruction set to take, as Highway calls it; empty: the processor's
  std::string table;  ///< Markdown file with the ratios; empty: none
};

FrameSet frame_set(const std::string& option, const std::string& name) {
  if (const std::optional<FrameSet> set = from_name<FrameSet>(name)) return *set;
  throw Error("command line", option, name, known_names<FrameSet>());
}

/// Takes the options of this program; what is left is Google Benchmark's.
Options parse(int argc, char** argv) {
  Options options;
  std::string frames = "paper", colors = "paper";
  const std::map<std::string, std::string*> values = {{"--cache", &options.settings.cache_folder},
                                                      {"--database", &options.settings.database},
                                                      {"--frames", &frames},
                                                      {"--colors", &colors},
                                                      {"--simd", &options.simd},
                                                      {"--table", &options.table}};
  for (int i = 1; i < argc; i += 2) {
    const auto option = values.find(argv[i]);
    if (option == values.end()) {
      throw Error("command line", argv[i], "an unknown option",
                  "--cache FOLDER, --database NAME, --frames SET, --colors SET, --simd NAME, --table FILE or an "
                  "option of Google Benchmark (--help)");
    }
    if (i + 1 == argc) throw Error("command line", argv[i], "nothing after it", "a value");
    *option->second = argv[i + 1];
  }
  options.settings.frames = frame_set("--frames", frames);
  options.settings.colors = frame_set("--colors", colors);
  return options;
}

/// The usual table, and after it the ratio of every engine to our fast one (speed_table.h).
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  /// Colors go to a terminal only.
  RatioReporter();

  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

  const Measurements& measurements() const { return measurements_; }
  /// Benchmarks that ended with an error, such as a failed check. A missing library is none.
  int error_count() const { return error_count_; }

 private:
  void add(const Run& run);

  Measurements measurements_;
  int error_count_ = 0;
};

double counter(const benchmark::UserCounters& counters, const char* name, double otherwise) {
  const auto found = counters.find(name);
  return found == counters.end() ? otherwise : found->second.value;
}

RatioReporter::RatioReporter() : ConsoleReporter(isatty(STDOUT_FILENO) != 0 ? OO_ColorTabular : OO_Tabular) {}

void RatioReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) add(run);
  ConsoleReporter::ReportRuns(runs);
}

void RatioReporter::add(const Run& run) {
  if (run.run_type == Run::RT_Aggregate) return;
  Measured& measured = measurements_[run.run_name.function_name];
  if (run.error_occurred) {
    measured.missing = run.error_message == kMissing;
    error_count_ += !measured.missing;
    return;
  }
  const double iteration = run.cpu_accumulated_time / static_cast<double>(run.iterations);
  measured.seconds[run.repetition_index] = counter(run.counters, "frame", counter(run.counters, "view", iteration));
  measured.near_bytes = counter(run.counters, kNearBytes, 0);
  measured.far_bytes = counter(run.counters, kFarBytes, 0);
}

void RatioReporter::Finalize() {
  GetOutputStream() << ratio_lines(engine_ratios(measurements_));
  GetOutputStream() << fmt::format("peak memory {:.0f} MB\n", 1e-6 * peak_memory());
  ConsoleReporter::Finalize();
}

/// Takes no instruction set that is better than this one.
void limit_simd(const std::string& name) {
  std::string known;
  int64_t allowed = 0;  // the better one has the lower bit
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    known += std::string(known.empty() ? "" : ", ") + hwy::TargetName(target);
    if (name == hwy::TargetName(target)) allowed = hwy::SupportedTargets() & ~(target - 1);
  }
  if (allowed == 0) throw Error("command line", "--simd", name, "one of " + known);
  hwy::SetSupportedTargetsForTest(allowed);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const Options options = parse(argc, argv);
  if (!options.simd.empty()) limit_simd(options.simd);
  prepare(options.settings);
  RatioReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  if (!options.table.empty()) write_file(options.table, speed_markdown(reporter.measurements()));
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
