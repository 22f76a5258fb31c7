#include "reports/statistics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "core/base/error.h"
#include "core/base/random.h"
#include "reports/text.h"

namespace glovebench::reports {
namespace {

void check_finite(std::span<const double> values) {
  for (const double value : values)
    check(std::isfinite(value), "a statistic was asked of a value that is not finite");
}

double sorted_percentile(std::span<const double> sorted, double share) {
  const double rank = share * static_cast<double>(sorted.size() - 1);
  const size_t below = static_cast<size_t>(rank);
  const size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (rank - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// Sum and count of the values in one block of one seed.
struct BlockSum {
  double sum = 0;
  int count = 0;
};

std::vector<BlockSum> block_sums(const std::vector<std::optional<double>>& values, int block_frames) {
  std::vector<BlockSum> sums((values.size() + block_frames - 1) / block_frames);
  for (size_t i = 0; i < values.size(); ++i) {
    if (!values[i]) continue;
    check(std::isfinite(*values[i]), "a statistic was asked of a value that is not finite");
    BlockSum& block = sums[i / block_frames];
    block.sum += *values[i];
    ++block.count;
  }
  return sums;
}

/// Mean of one draw of seeds and blocks; empty if it drew only lost frames.
std::optional<double> resampled_mean(const std::vector<std::vector<BlockSum>>& sums, RandomStream& random) {
  const size_t block_count = sums.front().size();
  std::vector<size_t> seeds(sums.size()), blocks(block_count);
  for (size_t& seed : seeds) seed = random.index(sums.size());
  for (size_t& block : blocks) block = random.index(block_count);
  BlockSum total;
  for (const size_t seed : seeds) {
    for (const size_t block : blocks) {
      total.sum += sums[seed][block].sum;
      total.count += sums[seed][block].count;
    }
  }
  if (total.count == 0) return std::nullopt;
  return total.sum / total.count;
}

/// Number of blocks of consecutive frames with similar lengths, none below `block_frames` unless there are too few
/// frames.
int block_count(const StratumShape& stratum, int block_frames) {
  return stratum.frames == 0 ? 0 : std::max(1, stratum.frames / block_frames);
}

Draw draw(const StratumShape& stratum, int block_frames, RandomStream& random) {
  Draw draw;
  for (int s = 0; s < stratum.seeds; ++s) draw.seeds.push_back(static_cast<int>(random.index(stratum.seeds)));
  const int blocks = block_count(stratum, block_frames);
  for (int b = 0; b < blocks; ++b) {
    const auto block = static_cast<int>(random.index(blocks));
    const int first = block * stratum.frames / blocks, end = (block + 1) * stratum.frames / blocks;
    for (int frame = first; frame < end; ++frame) draw.frames.push_back(frame);
  }
  return draw;
}

/// The probability that |T| < t for Student's T (Abramowitz and Stegun 26.7.3 and 26.7.4).
double share_within(double t, int degrees_of_freedom) {
  const double angle = std::atan(t / std::sqrt(degrees_of_freedom));
  const double cosine = std::cos(angle);
  const bool is_odd = degrees_of_freedom % 2 == 1;
  double sum = 0, term = is_odd ? cosine : 1;
  for (int k = is_odd ? 3 : 2; k <= degrees_of_freedom; k += 2) {
    sum += term;
    term *= cosine * cosine * (k - 1) / k;
  }
  return is_odd ? (angle + std::sin(angle) * sum) * 2 / std::numbers::pi : std::sin(angle) * sum;
}

void check_config(const BootstrapConfig& config) {
  check(config.block_frames >= 1 && config.resamples >= 1 && config.level > 0 && config.level < 1,
        "a bootstrap has blocks, resamples and a level between 0 and 1");
}

/// The middle `level` of the statistic's values in all draws. Empty without values. `where`: "of this movement".
std::optional<ConfidenceInterval> interval_of_draws(std::vector<double> values, const BootstrapConfig& config,
                                                    int seeds, int blocks, const std::string& where) {
  if (values.empty()) return std::nullopt;
  std::ranges::sort(values);
  ConfidenceInterval interval;
  interval.low = sorted_percentile(values, (1 - config.level) / 2);
  interval.high = sorted_percentile(values, (1 + config.level) / 2);
  interval.level = config.level;
  interval.seeds = seeds;
  interval.blocks = blocks;
  interval.block_frames = config.block_frames;
  interval.over =
      seeds > 1 ? "noise seeds and blocks of frames " + where : "blocks of frames " + where + ", one noise seed";
  return interval;
}

}  // namespace

std::optional<double> mean(std::span<const double> values) {
  check_finite(values);
  if (values.empty()) return std::nullopt;
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

std::optional<double> rms(std::span<const double> values) {
  check_finite(values);
  if (values.empty()) return std::nullopt;
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

std::optional<double> percentile(std::span<const double> values, double share) {
  check_finite(values);
  check(share >= 0 && share <= 1, "a percentile's share lies in 0..1");
  if (values.empty()) return std::nullopt;
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  return sorted_percentile(sorted, share);
}

Aggregate aggregate(std::span<const double> values) {
  return {static_cast<int>(values.size()), mean(values),           percentile(values, 0.5), rms(values),
          percentile(values, 0.95),        percentile(values, 1.0)};
}

PckCurve pck_curve(std::span<const double> errors_mm, size_t keypoint_count) {
  constexpr int kLargest_mm = 50;
  check_finite(errors_mm);
  check(errors_mm.size() <= keypoint_count, "there are no more errors than keypoints");
  PckCurve curve;
  if (keypoint_count == 0) return curve;
  for (int threshold = 0; threshold <= kLargest_mm; ++threshold) {
    const auto within = std::ranges::count_if(errors_mm, [&](double error) { return error <= threshold; });
    curve.thresholds_mm.push_back(threshold);
    curve.shares.push_back(static_cast<double>(within) / static_cast<double>(keypoint_count));
  }
  double area = 0;
  for (int i = 1; i <= kLargest_mm; ++i) area += (curve.shares[i - 1] + curve.shares[i]) / 2;
  curve.area = area / kLargest_mm;
  return curve;
}

std::optional<ConfidenceInterval> confidence_interval(
    const std::vector<std::vector<std::optional<double>>>& values_by_seed, const BootstrapConfig& config) {
  check_config(config);
  std::vector<std::vector<BlockSum>> sums;
  for (const auto& values : values_by_seed) {
    check(values.size() == values_by_seed.front().size(), "all seeds replay the same frames");
    sums.push_back(block_sums(values, config.block_frames));
  }
  if (sums.empty() || sums.front().size() < 2) return std::nullopt;

  RandomStream random(config.seed, "confidence_interval", 0, "bootstrap");
  std::vector<double> means;
  for (int i = 0; i < config.resamples; ++i)
    if (const auto resampled = resampled_mean(sums, random)) means.push_back(*resampled);
  return interval_of_draws(std::move(means), config, static_cast<int>(sums.size()),
                           static_cast<int>(sums.front().size()), "of this movement");
}

std::optional<ConfidenceInterval> stratified_interval(
    std::span<const StratumShape> strata,
    const std::function<std::optional<double>(std::span<const Draw>)>& statistic, const BootstrapConfig& config) {
  check_config(config);
  int seeds = 0, blocks = 0;
  for (const StratumShape& stratum : strata) {
    seeds = std::max(seeds, stratum.seeds);
    blocks += block_count(stratum, config.block_frames);
  }
  constexpr int kFewestBlocks = 5;  // fewer blocks give too few different draws
  if (blocks < kFewestBlocks) return std::nullopt;

  RandomStream random(config.seed, "stratified_interval", 0, "bootstrap");
  std::vector<double> values;
  std::vector<Draw> draws(strata.size());
  for (int i = 0; i < config.resamples; ++i) {
    for (size_t s = 0; s < strata.size(); ++s) draws[s] = draw(strata[s], config.block_frames, random);
    if (const auto value = statistic(draws)) values.push_back(*value);
  }
  check_finite(values);
  return interval_of_draws(std::move(values), config, seeds, blocks, "of these movements");
}

double student_quantile(double level, int degrees_of_freedom) {
  check(level > 0 && level < 1 && degrees_of_freedom >= 1, "a quantile has a level between 0 and 1");
  double low = 0, high = 1e6;
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (share_within(middle, degrees_of_freedom) < level ? low : high) = middle;
  }
  return (low + high) / 2;
}

double student_p(double t, int degrees_of_freedom) {
  check(t >= 0 && degrees_of_freedom >= 1, "a p-value is that of a distance");
  return std::max(0.0, 1 - share_within(t, degrees_of_freedom));
}

std::vector<double> holm_adjusted(std::span<const double> p_values) {
  std::vector<size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::stable_sort(order, {}, [&](size_t i) { return p_values[i]; });
  std::vector<double> adjusted(p_values.size());
  double before = 0;  // no hypothesis is significant if a smaller p-value is not
  for (size_t step = 0; step < order.size(); ++step) {
    const auto left = static_cast<double>(order.size() - step);
    before = std::max(before, std::min(1.0, left * p_values[order[step]]));
    adjusted[order[step]] = before;
  }
  return adjusted;
}

std::optional<ConfidenceInterval> student_interval(std::span<const double> values, const std::string& over,
                                                   double level) {
  constexpr size_t fewest = 5;
  const std::optional<double> center = mean(values);
  if (values.size() < fewest || std::ranges::adjacent_find(values, std::not_equal_to<>()) == values.end())
    return {};
  double squares = 0;
  for (const double value : values) squares += (value - *center) * (value - *center);
  const auto count = static_cast<double>(values.size());
  const double half =
      student_quantile(level, static_cast<int>(values.size()) - 1) * std::sqrt(squares / (count - 1) / count);
  ConfidenceInterval interval;
  interval.low = *center - half;
  interval.high = *center + half;
  interval.level = level;
  interval.over = over;
  return interval;
}

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
