#include "core/calibration/chroma.h"

#include <algorithm>
#include <cmath>

namespace glovebench::calibration {

ChromaDensity::ChromaDensity(std::span<const ColorSample> samples, double min_luma, double width)
    : cells_(static_cast<size_t>(kSide) * kSide) {
  double count = 0;
  for (const ColorSample& sample : samples) {
    const Eigen::Array3d rgb = array_of(sample.rgb);
    if (luma_of(rgb) < min_luma) continue;
    const Eigen::Vector2i place = cell_of(chroma_of(rgb));
    if (!is_inside(place)) continue;
    ++cells_[index(place)];
    ++count;
  }
  if (count == 0) return;
  for (double& cell : cells_) cell /= count;
  blur(width);
}

double ChromaDensity::at(const Chroma& chroma) const {
  const Eigen::Vector2i place = cell_of(chroma);
  return is_inside(place) ? cells_[index(place)] : 0.0;
}

bool ChromaDensity::is_flank(const Chroma& place, const KnownChroma& known) const {
  constexpr double kValley = 0.6;
  constexpr int kSteps = 24;
  double core = 0;  // the most that lies about the known place
  for (int i = -kSteps; i <= kSteps; ++i)
    for (int j = -kSteps; j <= kSteps; ++j) {
      const Chroma offset = Chroma(i, j) * (known.reach / kSteps);
      if (offset.norm() <= known.reach) core = std::max(core, at(known.place + offset));
    }
  if (core < at(place)) return false;
  double lowest = at(place);
  for (int i = 0; i <= kSteps; ++i) lowest = std::min(lowest, at(place + (known.place - place) * i / kSteps));
  return lowest > kValley * at(place);
}

std::vector<Chroma> ChromaDensity::peaks(std::vector<KnownChroma> known, double reach, double share,
                                         size_t most) const {
  std::vector<std::pair<double, Chroma>> candidates;  // cells that are as high as their neighbors
  for (int v = 1; v + 1 < kSide; ++v) {
    for (int u = 1; u + 1 < kSide; ++u) {
      const double density = cells_[index({u, v})];
      if (density <= share) continue;
      double highest = 0;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) highest = std::max(highest, cells_[index({u + i, v + j})]);
      if (density == highest)
        candidates.emplace_back(density, Chroma(u + 0.5, v + 0.5) * kCell + Chroma(kLeast, kLeast));
    }
  }
  std::ranges::stable_sort(candidates, std::greater<>(), [](const auto& candidate) { return candidate.first; });
  std::vector<Chroma> found;
  for (const auto& [density, place] : candidates) {
    const auto belongs_to = [&, peak = place](const KnownChroma& other) {
      return (peak - other.place).norm() < other.reach || is_flank(peak, other);
    };
    if (found.size() == most || std::ranges::any_of(known, belongs_to)) continue;
    found.push_back(place);
    known.push_back({place, reach});
  }
  return found;
}

Eigen::Vector2i ChromaDensity::cell_of(const Chroma& chroma) {
  return ((chroma.array() - kLeast) / kCell).floor().max(-1).min(kSide).cast<int>();
}

bool ChromaDensity::is_inside(const Eigen::Vector2i& place) {
  return place.minCoeff() >= 0 && place.maxCoeff() < kSide;
}

size_t ChromaDensity::index(const Eigen::Vector2i& place) {
  return static_cast<size_t>(place[1]) * kSide + static_cast<size_t>(place[0]);
}

void ChromaDensity::blur(double width) {
  const int reach = static_cast<int>(std::ceil(3 * width / kCell));
  std::vector<double> weights;
  for (int i = -reach; i <= reach; ++i) weights.push_back(std::exp(-0.5 * std::pow(i * kCell / width, 2)));
  for (const int step : {1, kSide}) {
    std::vector<double> blurred(cells_.size(), 0.0);
    for (int i = 0; i < static_cast<int>(cells_.size()); ++i) {
      if (cells_[i] == 0) continue;
      const int along = i / step % kSide;
      for (int d = std::max(-reach, -along); d <= std::min(reach, kSide - 1 - along); ++d)
        blurred[i + d * step] += weights[d + reach] * cells_[i];
    }
    cells_ = std::move(blurred);
  }
}

}  // namespace glovebench::calibration
