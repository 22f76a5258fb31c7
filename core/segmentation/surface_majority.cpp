#include "core/segmentation/surface_majority.h"

#include <array>
#include <cmath>

#include "core/base/check.h"

namespace glovebench {
namespace {

constexpr int kFewestVotes = 2;  // of a pixel without a label: one alone may be a speck

using Votes = std::array<int, kColorCount + 1>;

/// Of the neighborhood of (u, v), on its surface; index 0 counts all.
Votes votes_at(const LabelImage& labels, const DepthImage& depth, int u, int v, double depth_step) {
  Votes votes{};
  for (int j = v - 1; j <= v + 1; ++j) {
    for (int i = u - 1; i <= u + 1; ++i) {
      if (!labels.contains(i, j) || labels(i, j) == 0) continue;
      if (std::abs(static_cast<double>(depth(i, j)) - depth(u, v)) >= depth_step) continue;
      ++votes[labels(i, j)];
      ++votes[0];
    }
  }
  return votes;
}

uint8_t winner(const Votes& votes, uint8_t own) {
  if (own == 0 && votes[0] < kFewestVotes) return 0;
  uint8_t best = own;
  for (uint8_t label = 1; label <= kColorCount; ++label)
    if (votes[label] > (best == 0 ? 0 : votes[best])) best = label;
  return best;
}

}  // namespace

LabelImage surface_majority(const LabelImage& labels, const DepthImage& depth, double depth_step) {
  check(labels.width() == depth.width() && labels.height() == depth.height(), "labels and depth are of one camera");
  LabelImage filtered = labels;
  for (int v = 0; v < labels.height(); ++v)
    for (int u = 0; u < labels.width(); ++u)
      if (depth(u, v) > 0) filtered(u, v) = winner(votes_at(labels, depth, u, v, depth_step), labels(u, v));
  return filtered;
}

}  // namespace glovebench
