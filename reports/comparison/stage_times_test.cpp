#include "reports/comparison/stage_times.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/damaged_text.h"
#include "core/base/error.h"
#include "core/base/whole_file.h"
#include "core/test_folder.h"
#include "reports/test_text.h"
#include "reports/timings.h"

namespace glovebench::reports {
namespace {

using testing::HasSubstr;

class StageTimesFile : public testing::Test {
 protected:
  std::string write(const std::string& text) {
    write_file(path_, text);
    return path_;
  }
  const std::string path_ = test_folder() + "/timings.json";
};

Timings two_experiments() {
  Timings timings;
  timings.processor = "a processor";
  timings.threads = 2;
  ExperimentKey first, second;
  first.trajectory = "Tr1";
  second.trajectory = "Tr4";
  timings.experiments = {{first, 1, {{"align", {10, 12, 90}}, {"look up", {1, 2, 3}}}},
                         {second, 1, {{"align", {20, 20, 20}}}}};
  return timings;
}

TEST_F(StageTimesFile, MeansOfTheExperimentsMedians) {
  const StageTimes times = read_stage_times(write(timings_json(two_experiments())));
  EXPECT_EQ(times.processor, "a processor");
  EXPECT_EQ(times.threads, 2);
  ASSERT_EQ(times.stages.size(), 2u);
  EXPECT_EQ(times.stages[0].name, "align");
  EXPECT_DOUBLE_EQ(times.stages[0].median_ms, 16);
  EXPECT_DOUBLE_EQ(times.stages[1].median_ms, 2);
}

TEST_F(StageTimesFile, RoundTripsWithinAnotherFile) {
  const StageTimes times = read_stage_times(write(timings_json(two_experiments())));
  const nlohmann::json document = stage_times_json(times);
  const std::string where = "provenance.json";
  const StageTimes again = stage_times_from(JsonCursor(document, where));
  EXPECT_EQ(stage_times_json(again), stage_times_json(times));
}

TEST_F(StageTimesFile, RefusesWhatIsNoTime) {
  nlohmann::json document = nlohmann::json::parse(timings_json(two_experiments()));
  const auto error_of = [&](const nlohmann::json& changed) {
    return thrown_by([&] { read_stage_times(write(changed.dump())); });
  };
  nlohmann::json changed = document;
  changed["experiments"][1]["stages"]["align"]["median_ms"] = -1;
  EXPECT_THAT(error_of(changed), HasSubstr("experiments[1].stages.align.median_ms: found -1"));
  changed = document;
  changed["experiments"][0].erase("stages");
  EXPECT_THAT(error_of(changed), HasSubstr("experiments[0].stages"));
  changed = document;
  changed["format"] = "other";
  EXPECT_THAT(error_of(changed), HasSubstr("format"));
}

TEST_F(StageTimesFile, DamageGivesAnErrorOrTimesButNothingElse) {
  int refused = 0, accepted = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    RandomStream random(1, "stage_times_test", trial, "damage");
    write(damaged_text(timings_json(two_experiments()), random));
    try {
      const nlohmann::json document = stage_times_json(read_stage_times(path_));
      EXPECT_NO_THROW(stage_times_from(JsonCursor(document, path_)));
      ++accepted;
    } catch (const Error& error) {
      ++refused;
      EXPECT_THAT(error.what(), HasSubstr(path_));
    }
  }
  EXPECT_GT(refused, 300);
  EXPECT_GT(accepted, 20) << "another digit is another time";
}

TEST(StageTimes, ComparesTheStagesOfBoth) {
  const StageTimes before{"p", 2, {{"align", 10}, {"gone", 1}}};
  const StageTimes now{"p", 2, {{"new", 1}, {"align", 12}}};
  const StageTimeChanges changes = compare_stage_times(before, now);
  EXPECT_TRUE(changes.same_machine);
  ASSERT_EQ(changes.stages.size(), 1u);
  EXPECT_EQ(changes.stages[0].stage, "align");
  EXPECT_EQ(changes.stages[0].baseline_ms, 10);
  EXPECT_EQ(changes.stages[0].candidate_ms, 12);
  EXPECT_FALSE(compare_stage_times(before, {"q", 2, {}}).same_machine);
  EXPECT_FALSE(compare_stage_times(before, {"p", 4, {}}).same_machine);
}

}  // namespace
}  // namespace glovebench::reports
