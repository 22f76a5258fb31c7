// Baselines and runs that are replaced during reading.
#include "eval/regression/baseline.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <thread>

#include "core/base/hash.h"
#include "core/test_folder.h"
#include "reports/example_result.h"
#include "reports/results_json.h"
#include "reports/text.h"

namespace glovebench::eval {
namespace {

/// A baseline whose files all contain one number: 1, 2, ...
void write_baseline(const std::string& folder, int number) {
  reports::RunResult result = reports::small_result();
  result.commit = std::to_string(number);
  const std::string results = reports::results_json(result);
  const reports::StageTimes times = {"processor", 1, {{"align", static_cast<double>(number)}}};
  WholeFiles files(folder);
  files.add("results.json", results);
  files.add("speed.json", reports::speed_json({{"look_up", 1.0 * number, 1.0 * number, 1.0 * number}}));
  files.add("provenance.json", reports::format_json({{"format", "glovebench-provenance"},
                                                     {"version", 1},
                                                     {"results_hash", hash_text(results)},
                                                     {"times", reports::stage_times_json(times)}}));
  files.commit();
}

TEST(Baseline, that_is_replaced_while_it_is_read_does_not_mix) {
  const TestFolder folder;
  write_baseline(folder.path(), 1);
  const std::jthread writer([&](const std::stop_token& is_done) {
    for (int number = 2; !is_done.stop_requested(); ++number) write_baseline(folder.path(), number);
  });
  constexpr int kReads = 100;
  for (int reads = 0; reads < kReads;) {
    try {
      const Baseline baseline = load_baseline(folder.path());
      const double number = std::stod(baseline.run.results.result.commit);
      EXPECT_EQ(baseline.speed.at(0).ratio, number);
      EXPECT_EQ(baseline.times.stages.at(0).median_ms, number);
      ++reads;
    } catch (const reports::Incomparable&) {
      // Replaced twice since its manifest was read, so its files are gone.
    }
  }
}

TEST(Baseline, without_provenance_is_refused) {
  const TestFolder folder;
  write_baseline(folder.path(), 1);
  EXPECT_NO_THROW(load_baseline(folder.path()));
  for (const bool has_manifest : {true, false}) {
    if (!has_manifest) std::filesystem::remove(folder.path() + "/manifest.json");
    std::filesystem::remove(folder.path() + "/provenance.json");
    EXPECT_THROW(load_baseline(folder.path()), reports::Incomparable) << "nothing ties the results to a run";
  }
}

TEST(FinishedRun, that_was_replaced_since_is_not_read_on) {
  const TestFolder folder;
  write_baseline(folder.path(), 1);
  const FinishedRun run = load_finished_run(folder.path());
  EXPECT_EQ(load_stage_times(run.files).stages.at(0).median_ms, 1);
  write_baseline(folder.path(), 2);
  EXPECT_EQ(run.results.result.commit, "1");
  EXPECT_THROW(load_stage_times(run.files), reports::Incomparable);
}

}  // namespace
}  // namespace glovebench::eval
