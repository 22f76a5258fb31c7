#pragma once

#include <benchmark/benchmark.h>

#include "bench/speed_table.h"

namespace glovebench::bench {

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

}  // namespace glovebench::bench
