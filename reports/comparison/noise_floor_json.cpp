#include <set>

#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "core/base/read_limits.h"
#include "reports/comparison/noise_floor.h"
#include "reports/json_text.h"

namespace glovebench::reports {
namespace {

constexpr std::string_view kNoiseFloorFormat = "glovebench-noise-floor";
constexpr int kVersion = 1;

double read_amount(const JsonCursor& json) {
  constexpr double kLargest = 1e6;  // of millimeters, degrees and percents: damage, and still fit to be rounded
  const double amount = json.number();
  if (amount < 0 || amount > kLargest) json.fail("a number in 0..1e6");
  return amount;
}

NoiseFloorEntry read_entry(const JsonCursor& json) {
  json.expect_keys({"experiment", "quantity", "spread", "minimum_effect", "detectable"});
  return {json["experiment"].text(), json["quantity"].name(), read_amount(json["spread"]),
          read_amount(json["minimum_effect"]), read_amount(json["detectable"])};
}

double read_family_error(const JsonCursor& json) {
  const double error = json.number();
  if (error <= 0 || error >= 1) json.fail("a probability between 0 and 1");
  return error;
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
  floor.seeds = static_cast<int>(json["seeds"].integer(1, std::numeric_limits<int>::max()));
  floor.seeds_per_result = static_cast<int>(json["seeds_per_result"].integer(1, std::numeric_limits<int>::max()));
  floor.family_error = read_family_error(json["family_error"]);
  floor.commit = json["commit"].text();
  floor.date = json["date"].text();
  floor.entries = read_entries(json["entries"]);
  return floor;
}

}  // namespace glovebench::reports
