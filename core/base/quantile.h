#pragma once

#include <algorithm>
#include <optional>
#include <vector>

namespace glovebench {

/// The value that a share of the others lies below (0.5: the median); nothing of none.
inline std::optional<double> quantile_of(std::vector<double> values, double share) {
  if (values.empty()) return {};
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  const auto at = values.begin() + std::min(place, static_cast<std::ptrdiff_t>(values.size()) - 1);
  std::ranges::nth_element(values, at);
  return *at;
}

}  // namespace glovebench
