#include "bench/ratio_reporter.h"

#include <fmt/format.h>
#include <unistd.h>

#include "bench/bench_data.h"

namespace glovebench::bench {
namespace {

double counter(const benchmark::UserCounters& counters, const char* name, double otherwise) {
  const auto found = counters.find(name);
  return found == counters.end() ? otherwise : found->second.value;
}

}  // namespace

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

}  // namespace glovebench::bench
