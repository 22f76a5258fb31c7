#include "reports/statistics_json.h"

#include "reports/json_text.h"

namespace glovebench::reports {

nlohmann::ordered_json aggregate_json(const Aggregate& aggregate) {
  return {{"count", aggregate.count},
          {"mean", rounded_or_null(aggregate.mean)},
          {"median", rounded_or_null(aggregate.median)},
          {"rms", rounded_or_null(aggregate.rms)},
          {"p95", rounded_or_null(aggregate.p95)},
          {"max", rounded_or_null(aggregate.max)}};
}

Aggregate read_aggregate(const JsonCursor& json) {
  const auto value = [&](std::string_view key) { return json[key].number_or_null(0, kLargestError); };
  return {json["count"].count(), value("mean"), value("median"), value("rms"), value("p95"), value("max")};
}

nlohmann::ordered_json interval_json(const std::optional<ConfidenceInterval>& interval) {
  if (!interval) return nullptr;
  return {
      {"low", rounded(interval->low)}, {"high", rounded(interval->high)}, {"level", rounded(interval->level)},
      {"seeds", interval->seeds},      {"blocks", interval->blocks},      {"block_frames", interval->block_frames},
      {"over", interval->over}};
}

std::optional<ConfidenceInterval> read_interval(const JsonCursor& json, double min, double max) {
  if (json.is_null()) return std::nullopt;
  json.expect_keys({"low", "high", "level", "seeds", "blocks", "block_frames", "over"});
  return ConfidenceInterval{json["low"].number(min, max), json["high"].number(min, max),
                            json["level"].number(0, 1),   json["seeds"].count(),
                            json["blocks"].count(),       json["block_frames"].count(),
                            json["over"].text()};
}

}  // namespace glovebench::reports
