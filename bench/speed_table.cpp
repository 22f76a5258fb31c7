#include "bench/speed_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace glovebench::bench {
namespace {

/// Of at least one repetition.
double median(const std::map<int64_t, double>& repetitions) {
  std::vector<double> values;
  for (const auto& [number, value] : repetitions) values.push_back(value);
  std::ranges::sort(values);
  const size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

EngineRatio ratio_of(const Measured& engine, const Measured& fast) {
  EngineRatio result;
  result.seconds = median(engine.seconds);
  result.fast_seconds = median(fast.seconds);
  result.ratio = result.low = result.high = result.seconds / result.fast_seconds;
  for (const auto& [number, seconds] : engine.seconds) {
    const auto partner = fast.seconds.find(number);
    if (partner == fast.seconds.end()) continue;
    result.low = std::min(result.low, seconds / partner->second);
    result.high = std::max(result.high, seconds / partner->second);
  }
  return result;
}

/// Bytes a second; 0 if it was not measured.
double bandwidth(const Measurements& measurements, const std::string& name) {
  const auto found = measurements.find(name);
  if (found == measurements.end() || found->second.seconds.empty()) return 0;
  return (found->second.near_bytes + found->second.far_bytes) / median(found->second.seconds);
}

/// Three digits, or all before the point.
std::string digits(double value) {
  return value < 100 ? fmt::format("{:#.3g}", value) : fmt::format("{:.0f}", value);
}

std::string ms(double seconds) { return digits(1e3 * seconds); }

std::string ratio_table(const std::vector<EngineRatio>& ratios) {
  std::string text =
      "| stage | engine | ms | fast, ms | engine / fast | spread |\n| --- | --- | ---: | ---: | ---: | ---: |\n";
  for (const EngineRatio& row : ratios) {
    text += row.missing
                ? fmt::format("| {} | {} | missing | | | |\n", row.stage, row.engine)
                : fmt::format("| {} | {} | {} | {} | {} | {} to {} |\n", row.stage, row.engine, ms(row.seconds),
                              ms(row.fast_seconds), digits(row.ratio), digits(row.low), digits(row.high));
  }
  return text;
}

std::string floor_table(const std::vector<StageFloor>& floors) {
  std::string text =
      "| stage | touches, MB | floor, ms | ms | times the floor |\n| --- | ---: | ---: | ---: | ---: |\n";
  for (const StageFloor& row : floors) {
    text += fmt::format("| {} | {} | {} | {} | {} |\n", row.benchmark, digits(1e-6 * row.bytes),
                        ms(row.floor_seconds), ms(row.seconds), digits(row.seconds / row.floor_seconds));
  }
  return text;
}

}  // namespace

std::vector<EngineRatio> engine_ratios(const Measurements& measurements) {
  std::vector<EngineRatio> ratios;
  for (const auto& [name, engine] : measurements) {
    const size_t slash = name.rfind('/');
    if (slash == std::string::npos) continue;
    const std::string stage = name.substr(0, slash);
    const auto fast = measurements.find(stage + "/fast");
    if (fast == measurements.end() || name == fast->first || fast->second.seconds.empty()) continue;
    if (engine.seconds.empty() && !engine.missing) continue;  // it failed
    EngineRatio& ratio = ratios.emplace_back(engine.missing ? EngineRatio{} : ratio_of(engine, fast->second));
    ratio.stage = stage;
    ratio.engine = name.substr(slash + 1);
    ratio.missing = engine.missing;
  }
  std::ranges::stable_sort(ratios, {}, [](const EngineRatio& ratio) {
    return std::tuple(ratio.stage, ratio.engine != "plain", ratio.engine);
  });
  return ratios;
}

std::vector<StageFloor> stage_floors(const Measurements& measurements) {
  const double near = bandwidth(measurements, kNearBandwidth), far = bandwidth(measurements, kFarBandwidth);
  if (near == 0 || far == 0) return {};
  std::vector<StageFloor> floors;
  for (const auto& [name, stage] : measurements) {
    const double bytes = stage.near_bytes + stage.far_bytes;
    if (bytes == 0 || stage.seconds.empty() || name == kNearBandwidth || name == kFarBandwidth) continue;
    floors.push_back({name, bytes, stage.near_bytes / near + stage.far_bytes / far, median(stage.seconds)});
  }
  return floors;
}

std::string ratio_lines(const std::vector<EngineRatio>& ratios) {
  std::string text;
  for (const EngineRatio& row : ratios) {
    const std::string value = row.missing ? "missing" : fmt::format("{:.2f}", row.ratio);
    text += fmt::format("{:<18} {:<26} {:>8}\n", row.engine + " / fast", row.stage, value);
  }
  return text;
}

std::string speed_markdown(const Measurements& measurements) {
  const std::vector<StageFloor> floors = stage_floors(measurements);
  std::string text = ratio_table(engine_ratios(measurements));
  if (floors.empty()) return text;
  return text +
         fmt::format("\nRead bandwidth: {:.1f} GB/s near, {:.1f} GB/s far.\n\n",
                     1e-9 * bandwidth(measurements, kNearBandwidth),
                     1e-9 * bandwidth(measurements, kFarBandwidth)) +
         floor_table(floors);
}

}  // namespace glovebench::bench
