#include "core/tracker/detection.h"

#include <algorithm>
#include <cmath>

namespace glovebench {
namespace {

int border_pixels(const LabelImage& labels) {
  int count = 0;
  const int w = labels.width(), h = labels.height();
  for (int u = 0; u < w; ++u) count += (labels(u, 0) != 0) + (labels(u, h - 1) != 0);
  for (int v = 1; v + 1 < h; ++v) count += (labels(0, v) != 0) + (labels(w - 1, v) != 0);
  return count;
}

}  // namespace

bool is_cut_by_border(const LabelImage& labels, size_t glove_pixels, const DetectionConfig& config) {
  const double size_px = std::sqrt(static_cast<double>(glove_pixels));
  return border_pixels(labels) > std::min<double>(config.max_border_pixels, config.max_border_share * size_px);
}

TrackStatus detect(const LabeledCloud& cloud, const DetectionConfig& config) {
  if (static_cast<int>(cloud.points.size()) < config.min_pixels) {
    return cloud.labeled_outside >= config.min_pixels ? TrackStatus::outside_volume : TrackStatus::no_hand;
  }
  // A third of the glove is missing: what is left would be matched as if it were all.
  if (2 * cloud.labeled_cut_off > static_cast<int>(cloud.points.size())) return TrackStatus::outside_volume;
  if (is_cut_by_border(cloud.labels, cloud.points.size(), config)) return TrackStatus::cut_by_border;
  const RecycledVector<int> sizes = component_sizes(cloud, config.component_depth_step);
  if (sizes.size() > 1 && sizes[1] > config.second_hand_share * sizes[0]) return TrackStatus::several_hands;
  return TrackStatus::tracked;
}

}  // namespace glovebench
