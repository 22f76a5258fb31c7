#include "reports/comparison/speed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/input_file.h"
#include "core/base/json_cursor.h"
#include "core/base/parse_json.h"
#include "reports/results.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

constexpr std::string_view kSpeedFormat = "glovebench-speed";
constexpr size_t kMinRepetitions = 3;
/// An iteration takes between a picosecond and a day; within these bounds the ratio of two times is finite.
constexpr double kShortest_s = 1e-12, kLongest_s = 86400;
/// Far beyond any measured ratio, and large enough to survive a file's rounding.
constexpr double kLeastRatio = 1e-3, kLargestRatio = 1e6;

/// CPU seconds per iteration, by repetition.
using Repetitions = std::map<int64_t, double>;

bool is_ratio(double value) { return value >= kLeastRatio && value <= kLargestRatio; }

/// Names appear in one-line messages.
std::string read_benchmark_name(const JsonCursor& json) {
  const std::string name = json.text();
  if (std::ranges::any_of(name, [](unsigned char c) { return c < ' '; }))
    json.fail("a name without control characters");
  return name;
}

double seconds_of_unit(const JsonCursor& json) {
  const std::string unit = json.text();
  if (unit == "ns") return 1e-9;
  if (unit == "us") return 1e-6;
  if (unit == "ms") return 1e-3;
  if (unit == "s") return 1;
  json.fail("ns, us, ms or s");
}

double cpu_seconds(const JsonCursor& run) {
  const double seconds = run["cpu_time"].number() * seconds_of_unit(run["time_unit"]);
  if (!(seconds >= kShortest_s && seconds <= kLongest_s)) run["cpu_time"].fail("a time above zero, up to a day");
  return seconds;
}

/// Repetitions by benchmark. Leaves out aggregates, which carry the same names.
std::map<std::string, Repetitions> read_repetitions(const JsonCursor& benchmarks) {
  std::map<std::string, Repetitions> repetitions;
  for (const JsonCursor& run : benchmarks.items()) {
    if (run.has("error_occurred") && run["error_occurred"].boolean())
      run["error_occurred"].fail("a benchmark that did not fail");
    const std::string type = run["run_type"].text();
    if (type == "aggregate") continue;
    if (type != "iteration") run["run_type"].fail("iteration or aggregate");
    const int count = run["repetition_index"].count();
    if (!repetitions[read_benchmark_name(run["run_name"])].emplace(count, cpu_seconds(run)).second)
      run["repetition_index"].fail("each repetition once");
  }
  return repetitions;
}

double median(const Repetitions& repetitions) {
  std::vector<double> times;
  for (const auto& [index, seconds] : repetitions) times.push_back(seconds);
  std::ranges::sort(times);
  const size_t middle = times.size() / 2;
  return times.size() % 2 == 1 ? times[middle] : (times[middle - 1] + times[middle]) / 2;
}

SpeedRatio ratio_of(const std::string& name, const Repetitions& plain, const Repetitions& fast,
                    const std::string& where) {
  const size_t least = std::min(plain.size(), fast.size());
  if (least < kMinRepetitions) {
    throw Error(where, name, fmt::format("{} repetitions", least),
                fmt::format("at least {} (--benchmark_repetitions, and not aggregates only)", kMinRepetitions));
  }
  const double ratio = median(plain) / median(fast);
  std::vector<double> of_pairs;
  for (const auto& [index, seconds] : plain) {
    const auto partner = fast.find(index);
    if (partner == fast.end() || plain.size() != fast.size())
      throw Error(where, name, fmt::format("{} and {} repetitions", plain.size(), fast.size()),
                  "the same repetitions of plain and fast");
    of_pairs.push_back(seconds / partner->second);
  }
  std::ranges::sort(of_pairs);
  if (!is_ratio(of_pairs.front()) || !is_ratio(of_pairs.back()))
    throw Error(where, name, fmt::format("ratios of {:g} to {:g}", of_pairs.front(), of_pairs.back()),
                fmt::format("ones of {} to {}", kLeastRatio, kLargestRatio));
  // Another program may have disturbed one pair at each end.
  return {name, ratio, std::min(ratio, of_pairs[1]), std::max(ratio, of_pairs[of_pairs.size() - 2])};
}

std::vector<SpeedRatio> read_benchmarks(const JsonCursor& json, const std::string& where) {
  constexpr std::string_view kPlain = "/plain";
  const std::map<std::string, Repetitions> repetitions = read_repetitions(json["benchmarks"]);
  std::vector<SpeedRatio> ratios;
  for (const auto& [name, plain] : repetitions) {
    if (!name.ends_with(kPlain)) continue;
    const std::string stem = name.substr(0, name.size() - kPlain.size());
    const auto fast = repetitions.find(stem + "/fast");
    if (fast == repetitions.end()) throw Error(where, stem, "no " + stem + "/fast", "one beside " + name);
    ratios.push_back(ratio_of(stem, plain, fast->second, where));
  }
  return ratios;
}

double read_ratio(const JsonCursor& json) {
  const double ratio = json.number();
  if (!is_ratio(ratio)) json.fail(fmt::format("a ratio of {} to {}", kLeastRatio, kLargestRatio));
  return ratio;
}

std::vector<SpeedRatio> read_own(const JsonCursor& json) {
  json.expect_keys({"format", "version", "ratios"});
  json.expect_format(kSpeedFormat, 1);
  std::vector<SpeedRatio> ratios;
  for (const JsonCursor& item : json["ratios"].items()) {
    item.expect_keys({"name", "ratio", "low", "high"});
    ratios.push_back({read_benchmark_name(item["name"]), read_ratio(item["ratio"]), read_ratio(item["low"]),
                      read_ratio(item["high"])});
    const SpeedRatio& read = ratios.back();
    if (read.low > read.ratio || read.ratio > read.high) item["ratio"].fail("one from low to high");
    if (ratios.size() > 1 && ratios[ratios.size() - 2].name >= read.name)
      item["name"].fail("names in alphabetical order, each once");
  }
  return ratios;
}

}  // namespace

std::vector<SpeedRatio> read_speed_ratios(const std::string& path) {
  return parse_speed_ratios(read_file(path, kLargestSmallFile), path);
}

std::vector<SpeedRatio> parse_speed_ratios(const std::string& text, const std::string& where) {
  const nlohmann::json document = parse_json(text, where);
  const JsonCursor json(document, where);
  std::vector<SpeedRatio> ratios = json.has("format") ? read_own(json) : read_benchmarks(json, where);
  if (ratios.empty()) throw Error(where, "benchmarks", "no pair", "a pair NAME/plain, NAME/fast");
  return ratios;
}

std::string speed_json(const std::vector<SpeedRatio>& ratios) {
  nlohmann::ordered_json json = {
      {"format", kSpeedFormat}, {"version", 1}, {"ratios", nlohmann::ordered_json::array()}};
  for (const SpeedRatio& ratio : ratios) {
    json["ratios"].push_back({{"name", ratio.name},
                              {"ratio", rounded(ratio.ratio)},
                              {"low", rounded(ratio.low)},
                              {"high", rounded(ratio.high)}});
  }
  return format_json(json);
}

double speed_limit(double baseline) { return std::max(baseline / 2, std::sqrt(baseline)); }

std::vector<SpeedRow> compare_speed(const std::vector<SpeedRatio>& baseline,
                                    const std::vector<SpeedRatio>& candidate, const std::string& candidate_name) {
  std::vector<SpeedRow> rows;
  for (const SpeedRatio& before : baseline) {
    const auto after = std::ranges::find(candidate, before.name, &SpeedRatio::name);
    if (after == candidate.end())
      throw Incomparable(candidate_name, before.name, "nothing", "this ratio, which the baseline has");
    const double limit = speed_limit(before.ratio);
    rows.push_back({before.name, before.ratio, after->ratio, after->high, limit, after->high < limit});
  }
  return rows;
}

}  // namespace glovebench::reports
