#include "bench/ratio_reporter.h"

#include <fmt/format.h>
#include <unistd.h>

#include "bench/bench_data.h"

namespace glovebench::bench {

RatioReporter::RatioReporter() : ConsoleReporter(isatty(STDOUT_FILENO) != 0 ? OO_ColorTabular : OO_Tabular) {}

void RatioReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.error_occurred) {
      ++error_count_;
      continue;
    }
    const bool aggregate = run.run_type == Run::RT_Aggregate;
    if (aggregate && run.aggregate_name != "median") continue;
    // An aggregate's time is already that of one iteration; it comes after the runs it is made of.
    const double iterations = aggregate ? 1 : static_cast<double>(run.iterations);
    seconds_[run.run_name.function_name] = run.cpu_accumulated_time / iterations;
  }
  ConsoleReporter::ReportRuns(runs);
}

void RatioReporter::Finalize() {
  for (const auto& [name, seconds] : seconds_) {
    if (!name.ends_with("/plain")) continue;
    const std::string stem = name.substr(0, name.size() - std::string_view("/plain").size());
    const auto fast = seconds_.find(stem + "/fast");
    if (fast == seconds_.end()) continue;
    GetOutputStream() << fmt::format("plain / fast  {:<24} {:6.2f}\n", stem, seconds / fast->second);
  }
  GetOutputStream() << fmt::format("peak memory   {:.0f} MB\n", 1e-6 * peak_memory());
  ConsoleReporter::Finalize();
}

}  // namespace glovebench::bench
