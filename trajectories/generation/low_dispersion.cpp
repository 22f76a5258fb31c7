#include "trajectories/generation/low_dispersion.h"

#include <algorithm>
#include <limits>
#include <string>

#include "core/base/error.h"

namespace glovebench::trajectories {
namespace {

double nearest_distance(const Posture& posture, const std::vector<Posture>& chosen) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Posture& other : chosen) nearest = std::min(nearest, posture_distance(posture, other));
  return nearest;
}

}  // namespace

std::vector<size_t> low_dispersion_sample(const std::vector<Posture>& pool, const std::vector<Posture>& given,
                                          size_t count) {
  if (pool.size() < count) {
    throw Error("low-dispersion sampling", "pool", std::to_string(pool.size()) + " postures",
                "at least " + std::to_string(count));
  }
  if (given.empty()) throw Error("low-dispersion sampling", "given postures", "none", "at least one");
  std::vector<double> distances;
  for (const Posture& posture : pool) distances.push_back(nearest_distance(posture, given));

  std::vector<size_t> sample;
  while (sample.size() < count) {
    const auto farthest = std::ranges::max_element(distances) - distances.begin();
    sample.push_back(static_cast<size_t>(farthest));
    for (size_t i = 0; i < pool.size(); ++i)
      distances[i] = std::min(distances[i], posture_distance(pool[i], pool[sample.back()]));
    distances[sample.back()] = -1;  // never twice, even in a pool of equal postures
  }
  return sample;
}

double covering_radius(const std::vector<Posture>& pool, const std::vector<Posture>& chosen) {
  if (pool.empty() || chosen.empty()) throw Error("covering radius", "postures", "none", "at least one");
  double radius = 0;
  for (const Posture& posture : pool) radius = std::max(radius, nearest_distance(posture, chosen));
  return radius;
}

}  // namespace glovebench::trajectories
