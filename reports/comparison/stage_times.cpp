#include "reports/comparison/stage_times.h"

#include <algorithm>

#include "core/base/input_file.h"
#include "core/base/parse_json.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

double milliseconds(const JsonCursor& json) {
  const double value = json.number();
  if (!(value >= 0 && value <= 1e9)) json.fail("milliseconds, 0 to 1e9");
  return value;
}

}  // namespace

StageTimes read_stage_times(const std::string& timings_path) {
  return parse_stage_times(read_file(timings_path, kLargestSmallFile), timings_path);
}

StageTimes parse_stage_times(const std::string& text, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  const JsonCursor json(document, where);
  json.expect_format("glovebench-timings", 1);
  StageTimes times{json["processor"].text(), json["threads"].count(), {}};
  const JsonItems experiments = json["experiments"].items();
  std::vector<int> counts;
  for (const JsonCursor& experiment : experiments) {
    for (const auto& [name, stage] : experiment["stages"].members()) {
      if (stage["median_ms"].is_null()) continue;
      const auto s = std::ranges::find(times.stages, name, &StageTimes::Stage::name) - times.stages.begin();
      if (s == std::ssize(times.stages)) {
        times.stages.push_back({name, 0});
        counts.push_back(0);
      }
      times.stages[s].median_ms += milliseconds(stage["median_ms"]);
      ++counts[s];
    }
  }
  for (size_t s = 0; s < counts.size(); ++s) times.stages[s].median_ms /= counts[s];
  return times;
}

nlohmann::ordered_json stage_times_json(const StageTimes& times) {
  nlohmann::ordered_json stages = nlohmann::ordered_json::object();
  for (const StageTimes::Stage& stage : times.stages) stages[stage.name] = rounded(stage.median_ms);
  return {{"processor", times.processor}, {"threads", times.threads}, {"stage_median_ms", stages}};
}

StageTimes stage_times_from(const JsonCursor& json) {
  json.expect_keys({"processor", "threads", "stage_median_ms"});
  StageTimes times{json["processor"].text(), json["threads"].count(), {}};
  for (const auto& [name, value] : json["stage_median_ms"].members())
    times.stages.push_back({name, milliseconds(value)});
  return times;
}

StageTimeChanges compare_stage_times(const StageTimes& baseline, const StageTimes& candidate) {
  StageTimeChanges changes{baseline.processor == candidate.processor && baseline.threads == candidate.threads, {}};
  for (const StageTimes::Stage& before : baseline.stages) {
    const auto now = std::ranges::find(candidate.stages, before.name, &StageTimes::Stage::name);
    if (now != candidate.stages.end()) changes.stages.push_back({before.name, before.median_ms, now->median_ms});
  }
  return changes;
}

}  // namespace glovebench::reports
