#include "eval/studies/sample.h"

#include "core/base/error.h"

namespace glovebench::eval {
namespace {

using reports::Draw;
using reports::StratumShape;

std::vector<StratumShape> shape_of(const Sample& sample) {
  std::vector<StratumShape> shape;
  for (const auto& seeds : sample) {
    check(!seeds.empty(), "a stratum has a seed");
    shape.push_back({static_cast<int>(seeds.size()), static_cast<int>(seeds.front().size())});
    for (const auto& frames : seeds)
      check(frames.size() == seeds.front().size(), "all seeds replay the same frames");
  }
  return shape;
}

bool same_shape(const Sample& a, const Sample& b) {
  const auto x = shape_of(a), y = shape_of(b);
  return std::ranges::equal(x, y, [](const StratumShape& s, const StratumShape& t) {
    return s.seeds == t.seeds && s.frames == t.frames;
  });
}

std::optional<double> mean_of(const Sample& sample, std::span<const Draw> draws) {
  double sum = 0;
  int count = 0;
  for (size_t s = 0; s < sample.size(); ++s) {
    for (const int seed : draws[s].seeds) {
      for (const int frame : draws[s].frames) {
        const std::optional<double>& value = sample[s][seed][frame];
        if (!value) continue;
        sum += *value;
        ++count;
      }
    }
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

/// All seeds and frames, once each.
std::vector<Draw> everything(const Sample& sample) {
  std::vector<Draw> draws;
  for (const StratumShape& stratum : shape_of(sample)) {
    Draw& draw = draws.emplace_back();
    for (int seed = 0; seed < stratum.seeds; ++seed) draw.seeds.push_back(seed);
    for (int frame = 0; frame < stratum.frames; ++frame) draw.frames.push_back(frame);
  }
  return draws;
}

template <typename Combine>
Sample combined(const Sample& a, const Sample& b, const Combine& combine) {
  check(same_shape(a, b), "samples of the same frames are combined");
  Sample result = a;
  for (size_t s = 0; s < a.size(); ++s)
    for (size_t seed = 0; seed < a[s].size(); ++seed)
      for (size_t f = 0; f < a[s][seed].size(); ++f) result[s][seed][f] = combine(a[s][seed][f], b[s][seed][f]);
  return result;
}

}  // namespace

std::optional<double> mean(const Sample& sample) { return mean_of(sample, everything(sample)); }

Estimated estimate(std::span<const Sample> samples,
                   const std::function<std::optional<double>(std::span<const double> means)>& combine) {
  check(!samples.empty(), "there is a sample to estimate from");
  for (const Sample& sample : samples) check(same_shape(samples.front(), sample), "samples are of the same frames");
  const auto statistic = [&](std::span<const Draw> draws) -> std::optional<double> {
    std::vector<double> means;
    for (const Sample& sample : samples) {
      const std::optional<double> mean = mean_of(sample, draws);
      if (!mean) return std::nullopt;
      means.push_back(*mean);
    }
    return combine(means);
  };
  const std::optional<double> value = statistic(everything(samples.front()));
  if (!value) return {};
  return {value, reports::stratified_interval(shape_of(samples.front()), statistic)};
}

Estimated estimate_mean(const Sample& sample) {
  return estimate({&sample, 1}, [](std::span<const double> means) { return std::optional(means[0]); });
}

Estimated estimate_difference(const Sample& a, const Sample& b) {
  return estimate_mean(combined(a, b, [](const std::optional<double>& x, const std::optional<double>& y) {
    return x && y ? std::optional(*x - *y) : std::nullopt;
  }));
}

std::optional<reports::ConfidenceInterval> interval_over(
    int count, const std::string& over,
    const std::function<std::optional<double>(std::span<const int> drawn)>& statistic) {
  const StratumShape all{1, count};
  reports::BootstrapConfig config;
  config.block_frames = 1;
  auto interval = reports::stratified_interval(
      {&all, 1}, [&](std::span<const Draw> draws) { return statistic(draws.front().frames); }, config);
  if (interval) interval->over = over;
  return interval;
}

Sample where(const Sample& sample, const Sample& keep) {
  return combined(sample, keep, [](const std::optional<double>& x, const std::optional<double>& k) {
    return k && *k != 0 ? x : std::nullopt;
  });
}

}  // namespace glovebench::eval
