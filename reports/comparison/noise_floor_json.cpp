#include <set>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "reports/comparison/noise_floor.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

constexpr std::string_view kNoiseFloorFormat = "glovebench-noise-floor";
constexpr int kVersion = 1;

/// In millimeters, degrees or percent: larger values are damage, smaller ones are written as 0.
constexpr double kLargestAmount = 1e6, kSmallestAmount = 1e-6;

NoiseFloorEntry read_entry(const JsonCursor& json) {
  json.expect_keys({"experiment", "quantity", "spread", "minimum_effect", "detectable"});
  return {json["experiment"].text(), json["quantity"].name(), json["spread"].number(0, kLargestAmount),
          json["minimum_effect"].number(kSmallestAmount, kLargestAmount),
          json["detectable"].number(0, kLargestAmount)};
}

std::vector<NoiseFloorEntry> read_entries(const JsonCursor& json) {
  std::vector<NoiseFloorEntry> entries;
  std::set<std::pair<std::string, std::string>> known;
  for (const JsonCursor& item : json.items()) {
    entries.push_back(read_entry(item));
    if (!known.emplace(entries.back().experiment, entries.back().quantity).second)
      item.fail("an experiment and quantity that is not above");
  }
  return entries;
}

}  // namespace

std::string noise_floor_json(const NoiseFloor& floor) {
  nlohmann::ordered_json json = {{"format", kNoiseFloorFormat},
                                 {"version", kVersion},
                                 {"suite", floor.suite},
                                 {"seeds", floor.seeds},
                                 {"seeds_per_result", floor.seeds_per_result},
                                 {"family_error", floor.family_error},
                                 {"commit", floor.commit},
                                 {"date", floor.date},
                                 {"entries", nlohmann::ordered_json::array()}};
  for (const NoiseFloorEntry& entry : floor.entries)
    json["entries"].push_back({{"experiment", entry.experiment},
                               {"quantity", entry.quantity},
                               {"spread", rounded(entry.spread)},
                               {"minimum_effect", rounded(entry.minimum_effect)},
                               {"detectable", rounded(entry.detectable)}});
  return format_json(json);
}

NoiseFloor read_noise_floor(const std::string& path) {
  return parse_noise_floor(read_file(path, kLargestSmallFile), path);
}

NoiseFloor parse_noise_floor(const std::string& text, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  const JsonCursor json(document, where);
  json.expect_format(kNoiseFloorFormat, kVersion);
  json.expect_keys(
      {"format", "version", "suite", "seeds", "seeds_per_result", "family_error", "commit", "date", "entries"});
  NoiseFloor floor;
  floor.suite = json["suite"].text();
  floor.seeds = static_cast<int>(json["seeds"].integer(kSeedsForEach, std::numeric_limits<int>::max()));
  floor.seeds_per_result = static_cast<int>(json["seeds_per_result"].integer(1, floor.seeds / kSeedsForEach));
  floor.family_error = json["family_error"].number(kSmallestAmount, kLargestFamilyError);
  floor.commit = json["commit"].text();
  floor.date = json["date"].text();
  floor.entries = read_entries(json["entries"]);
  return floor;
}

}  // namespace glovebench::reports
