#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>

namespace glovebench::bench {

/// The usual table, and after it the ratio plain / fast of every pair of benchmarks "NAME/plain" and "NAME/fast",
/// both timed in this process: of the medians if there were repetitions.
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  /// Colors go to a terminal only.
  RatioReporter();

  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

  /// Benchmarks that ended with an error, such as a failed check.
  int error_count() const { return error_count_; }

 private:
  std::map<std::string, double> seconds_;  ///< CPU time of an iteration by the benchmark's name
  int error_count_ = 0;
};

}  // namespace glovebench::bench
