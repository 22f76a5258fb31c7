#include "reports/timings.h"

#include "reports/study.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

using Json = nlohmann::ordered_json;

Json times_json(const std::vector<double>& ms) {
  const Aggregate a = aggregate(ms);
  return {{"count", a.count},
          {"mean_ms", rounded_or_null(a.mean)},
          {"median_ms", rounded_or_null(a.median)},
          {"p95_ms", rounded_or_null(a.p95)},
          {"max_ms", rounded_or_null(a.max)}};
}

Json timing_json(const ExperimentTiming& timing) {
  Json stages = Json::object();
  for (const StageTiming& stage : timing.stages) stages[stage.stage] = times_json(stage.frame_ms);
  Json json = {
      {"experiment", to_string(timing.key)}, {"wall_s", rounded(timing.wall_s)}, {"stages", std::move(stages)}};
  if (!timing.command_ms.empty()) {
    Json& latency = json["frame_to_command"] = times_json(timing.command_ms);
    latency["p99_ms"] = rounded_or_null(percentile(timing.command_ms, 0.99));
  }
  return json;
}

}  // namespace

std::string timings_json(const Timings& timings, const std::vector<StudyResult>& studies) {
  Json json = {{"format", "glovebench-timings"},
               {"version", 1},
               {"host", timings.host},
               {"processor", timings.processor},
               {"threads", timings.threads},
               {"compiler", timings.compiler},
               {"build_type", timings.build_type},
               {"commit", timings.commit},
               {"date", timings.date},
               {"wall_s", rounded(timings.wall_s)},
               {"peak_memory_mb", rounded_or_null(timings.peak_memory_mb)},
               {"experiments", array_of(timings.experiments, timing_json)}};
  if (Json times = study_times_json(studies); !times.empty()) json["studies"] = std::move(times);
  return format_json(json);
}

}  // namespace glovebench::reports
