#include "reports/interval_json.h"

#include "reports/json_text.h"

namespace glovebench::reports {

nlohmann::ordered_json interval_json(const std::optional<ConfidenceInterval>& interval) {
  if (!interval) return nullptr;
  return {
      {"low", rounded(interval->low)}, {"high", rounded(interval->high)}, {"level", rounded(interval->level)},
      {"seeds", interval->seeds},      {"blocks", interval->blocks},      {"block_frames", interval->block_frames},
      {"over", interval->over}};
}

std::optional<ConfidenceInterval> read_interval(const JsonReader& json, double min, double max) {
  if (json.is_null()) return std::nullopt;
  json.expect_keys({"low", "high", "level", "seeds", "blocks", "block_frames", "over"});
  return ConfidenceInterval{json["low"].number(min, max), json["high"].number(min, max),
                            json["level"].number(0, 1),   json["seeds"].count(),
                            json["blocks"].count(),       json["block_frames"].count(),
                            json["over"].text()};
}

}  // namespace glovebench::reports
